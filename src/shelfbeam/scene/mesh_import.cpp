#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <system_error>

#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/store_parts.hpp"

namespace shelfbeam {

namespace {

// What is not UTF-8 shows as one '?' a byte.
std::string material_name(const aiScene& scene, const aiMesh& mesh) {
  std::string name = scene.mMaterials[mesh.mMaterialIndex]->GetName().C_Str();
  if (!is_utf8(name))
    std::replace_if(
        name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) > 127; }, '?');
  return name;
}

bool is_gltf(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".gltf" || extension == ".glb";
}

std::optional<MaterialId> mapped(const std::string& name,
                                 const std::vector<std::pair<std::string, MaterialId>>& materials) {
  for (const auto& [pattern, material] : materials)
    if (matches_glob(name, pattern)) return material;
  return std::nullopt;
}

MeshPiece take_piece(const aiMesh& mesh, bool y_is_up, const std::string& where) {
  MeshPiece piece;
  for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
    const aiVector3D& p = mesh.mVertices[v];
    const Vec3 vertex = y_is_up ? Vec3{p.x, -p.z, p.y} : Vec3{p.x, p.y, p.z};
    if (!is_finite(vertex))
      throw InputError(where, fmt::format("vertex {} of mesh '{}' is not finite", v, mesh.mName.C_Str()),
                       "repair the mesh in the program that wrote it");
    piece.vertices.push_back(vertex);
  }
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    if (face.mNumIndices == 3)
      piece.triangles.push_back({face.mIndices[0], face.mIndices[1], face.mIndices[2]});
  }
  return piece;
}

}  // namespace

std::vector<MeshPiece> import_mesh(const std::filesystem::path& file, std::optional<bool> y_is_up,
                                   const std::vector<std::pair<std::string, MaterialId>>& materials,
                                   const std::string& where) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    throw InputError(where, fmt::format("the mesh '{}' does not exist", file.string()),
                     "paths are relative to the store file");
  Assimp::Importer importer;
  const aiScene* scene =
      importer.ReadFile(file.string(), aiProcess_Triangulate | aiProcess_PreTransformVertices |
                                           aiProcess_JoinIdenticalVertices | aiProcess_SortByPType);
  if (scene == nullptr)
    throw InputError(
        where, fmt::format("the mesh '{}' cannot be read ({})", file.string(), importer.GetErrorString()),
        "use glTF, GLB or OBJ");

  std::vector<MeshPiece> pieces;
  std::set<std::string> unmatched;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& mesh = *scene->mMeshes[m];
    MeshPiece piece = take_piece(mesh, y_is_up.value_or(is_gltf(file)), where);
    if (piece.triangles.empty()) continue;
    piece.name = material_name(*scene, mesh);
    if (const auto material = mapped(piece.name, materials)) {
      piece.material = *material;
      pieces.push_back(std::move(piece));
    } else {
      unmatched.insert(piece.name);
    }
  }
  if (!unmatched.empty()) {
    const std::vector<std::string_view> list(unmatched.begin(), unmatched.end());
    throw InputError(where,
                     fmt::format("nothing in 'materials' matches these materials of '{}': {}", file.string(),
                                 join(list, ", ")),
                     "add an entry for each, e.g. \"*\"");
  }
  if (pieces.empty())
    throw InputError(where, fmt::format("the mesh '{}' has no triangles", file.string()), "check it");
  return pieces;
}

}  // namespace shelfbeam
