#include <algorithm>
#include <filesystem>
#include <set>
#include <system_error>

#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/mesh_text.hpp"
#include "shelfbeam/scene/store_parts.hpp"

namespace shelfbeam {

namespace {

std::string printable(std::string name) {
  if (!is_utf8(name))
    std::replace_if(
        name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) > 127; }, '?');
  return name;
}

// Empty where the file names none; Assimp makes a name up then.
std::string material_name(const aiScene& scene, const aiMesh& mesh, const std::string& extension) {
  if (extension == ".stl" || extension == ".ply") return {};
  const std::string name = scene.mMaterials[mesh.mMaterialIndex]->GetName().C_Str();
  return name == AI_DEFAULT_MATERIAL_NAME ? "" : printable(name);
}

// Before the vertices are joined and moved, so that they are counted as in the file.
void expect_finite(const aiScene& scene, const std::filesystem::path& file, const std::string& where) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m)
    for (unsigned v = 0; v < scene.mMeshes[m]->mNumVertices; ++v) {
      const aiVector3D& p = scene.mMeshes[m]->mVertices[v];
      if (is_finite(Vec3{p.x, p.y, p.z})) continue;
      const std::string name = printable(scene.mMeshes[m]->mName.C_Str());
      throw InputError(where,
                       fmt::format("vertex {} (counted from 0) {}of '{}' is not finite", v,
                                   name.empty() ? "" : fmt::format("of mesh '{}' ", name), file.string()),
                       "repair the mesh in the program that wrote it");
    }
}

std::optional<MaterialId> mapped(const std::string& name,
                                 const std::vector<std::pair<std::string, MaterialId>>& materials) {
  for (const auto& [pattern, material] : materials)
    if (matches_glob(name, pattern)) return material;
  return std::nullopt;
}

MeshPiece take_piece(const aiMesh& mesh, bool y_is_up, const std::filesystem::path& file,
                     const std::string& where) {
  MeshPiece piece;
  for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
    const aiVector3D& p = mesh.mVertices[v];
    piece.vertices.push_back(y_is_up ? Vec3{p.x, -p.z, p.y} : Vec3{p.x, p.y, p.z});
    if (!is_finite(piece.vertices.back()))
      throw InputError(where, fmt::format("a node of '{}' moves a vertex beyond all numbers", file.string()),
                       "repair the mesh in the program that wrote it");
  }
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    if (face.mNumIndices == 3)
      piece.triangles.push_back({face.mIndices[0], face.mIndices[1], face.mIndices[2]});
  }
  return piece;
}

[[noreturn]] void fail_unmatched(const std::set<std::string>& names, const std::filesystem::path& file,
                                 const std::string& where) {
  std::vector<std::string_view> list(names.begin(), names.end());
  const bool has_unnamed = list.front().empty();
  if (has_unnamed) list.erase(list.begin());
  if (list.empty())
    throw InputError(where, fmt::format("surfaces of '{}' name no material", file.string()),
                     "give 'materials' an entry \"*\", which stands for all");
  throw InputError(where,
                   fmt::format("nothing in 'materials' matches these materials of '{}': {}{}", file.string(),
                               join(list, ", "), has_unnamed ? ", nor the surfaces that name none" : ""),
                   "add an entry for each, e.g. \"*\"");
}

}  // namespace

std::vector<MeshPiece> import_mesh(const std::filesystem::path& file, std::optional<bool> y_is_up,
                                   const std::vector<std::pair<std::string, MaterialId>>& materials,
                                   const std::string& where) {
  const std::string extension = mesh_extension(file);
  const bool is_gltf = extension == ".gltf" || extension == ".glb";
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    throw InputError(where, fmt::format("'{}' is a folder", file.string()), "name a file in it");
  if (!std::filesystem::is_regular_file(file, ignored))
    throw InputError(where, fmt::format("the mesh '{}' does not exist", file.string()),
                     "paths are relative to the store file");
  // Assimp has readers of many more formats, which are not checked here.
  if (!is_gltf && extension != ".obj" && extension != ".stl" && extension != ".ply")
    throw InputError(where,
                     fmt::format("the name of the mesh '{}' says of no format that is read", file.string()),
                     "use glTF (.gltf, .glb), OBJ (.obj), STL (.stl) or PLY (.ply)");
  check_mesh_text(file, where);
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(file.string(), 0);
  if (scene != nullptr) {
    expect_finite(*scene, file, where);
    scene = importer.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_PreTransformVertices |
                                         aiProcess_JoinIdenticalVertices | aiProcess_SortByPType);
  }
  if (scene == nullptr)
    throw InputError(
        where, fmt::format("the mesh '{}' cannot be read ({})", file.string(), importer.GetErrorString()),
        "it is damaged, or of another format than its name says; export it again");

  std::vector<MeshPiece> pieces;
  std::set<std::string> unmatched;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& mesh = *scene->mMeshes[m];
    MeshPiece piece = take_piece(mesh, y_is_up.value_or(is_gltf), file, where);
    if (piece.triangles.empty()) continue;
    piece.name = material_name(*scene, mesh, extension);
    if (const auto material = mapped(piece.name, materials)) {
      piece.material = *material;
      pieces.push_back(std::move(piece));
    } else {
      unmatched.insert(piece.name);
    }
  }
  if (!unmatched.empty()) fail_unmatched(unmatched, file, where);
  if (pieces.empty())
    throw InputError(where, fmt::format("the mesh '{}' has no triangles", file.string()), "check it");
  return pieces;
}

}  // namespace shelfbeam
