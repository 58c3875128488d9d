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

/// Triangles of one material out of a mesh file, in the file's units, z up.
struct MeshPiece {
  std::string name;  ///< of the material in the file
  MaterialId material;
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Pieces of the mesh file of that name in the folder (glTF, GLB, OBJ, STL, PLY), nodes placed, materials
/// mapped: the first pattern of `materials` (pattern -> material) that matches the name in the file counts;
/// surfaces that name no material, as all of STL and PLY, have the empty name. Throws InputError, among
/// others for what is not finite. Where `y_is_up` is not given, y is up in glTF, which defines it so, and z
/// in the other formats, which say nothing.
std::vector<MeshPiece> import_mesh(const std::filesystem::path& name, const StoreFolder& folder,
                                   std::optional<bool> y_is_up,
                                   const std::vector<std::pair<std::string, MaterialId>>& materials,
                                   const std::string& where);

}  // namespace shelfbeam
