#pragma once

#include "shelfbeam/scene/mesh_lines.hpp"

namespace shelfbeam {

/// Walks through a PLY file, ASCII or binary, as Assimp will, which trusts the header: throws InputError
/// where the file ends before what its header announces, a face names a vertex that there is not, or the
/// coordinate of an ASCII file is no finite number.
void check_ply(MeshLines& lines);

}  // namespace shelfbeam
