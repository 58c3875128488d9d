#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "shelfbeam/base/ids.hpp"
#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/scene/store_folder.hpp"

namespace shelfbeam {

/// Triangles of one material from a mesh file, in the file's unit of length, z up.
struct MeshPiece {
  std::string name;  ///< the material's name in the file
  MaterialId material;
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

struct ImportedMesh {
  std::vector<MeshPiece> pieces;
  std::vector<std::string> notes;  ///< remarks for the user about this file
  bool is_whole = true;            ///< its file names no other files
};

/// Imports a mesh file (glTF, GLB, OBJ, STL, PLY) from the folder as pieces, with node transformations
/// applied and materials mapped: the first pattern of `materials` (pattern -> material) that matches the name
/// in the file applies. Surfaces without a material, such as all of STL and PLY, have the empty name. By
/// default, y is up in glTF, as its specification defines, and z is up in the other formats. A file that has
/// not changed since it was imported for the cache of the folder is not read again. Throws InputError, also
/// for coordinates that are not finite.
ImportedMesh import_mesh(const std::filesystem::path& name, const StoreFolder& folder,
                         std::optional<bool> y_is_up,
                         const std::vector<std::pair<std::string, MaterialId>>& materials,
                         const std::string& where);

}  // namespace shelfbeam
