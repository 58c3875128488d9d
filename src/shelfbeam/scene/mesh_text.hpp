#pragma once

#include <filesystem>
#include <string>

namespace shelfbeam {

/// The extension in lower case, ".obj".
std::string mesh_extension(const std::filesystem::path& file);

/// Refuses a coordinate that is no finite number in an OBJ, an ASCII STL or an ASCII PLY file; other files
/// pass. Assimp reads such a text as 0 or as what stands before it, so it is looked for in the file itself.
/// Throws InputError with `where`, the file and the line.
void check_mesh_text(const std::filesystem::path& file, const std::string& where);

}  // namespace shelfbeam
