#include "shelfbeam/scene/mesh/mesh_import.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <set>
#include <unordered_map>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/files/file_time.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/mesh/mesh_formats.hpp"
#include "shelfbeam/scene/mesh/read_cache.hpp"

namespace shelfbeam {

namespace {

std::optional<MaterialId> mapped(const std::string& name,
                                 const std::vector<std::pair<std::string, MaterialId>>& materials) {
  for (const auto& [pattern, material] : materials)
    if (matches_glob(name, pattern)) return material;
  return std::nullopt;
}

struct PositionHash {
  std::size_t operator()(const Vec3& p) const {
    std::size_t hash = 0;
    // Adding 0 turns -0 into +0.
    for (int axis = 0; axis < 3; ++axis)
      hash = (hash ^ std::bit_cast<std::uint64_t>(p[axis] + 0.0)) * 0x9E3779B97F4A7C15U;
    return hash ^ hash >> 32;
  }
};

// Corners at the same position become one vertex.
MeshPiece piece_of(const MeshTriangles::OfMaterial& part, bool y_is_up) {
  MeshPiece piece;
  piece.name = printable(part.name);
  std::unordered_map<Vec3, std::uint32_t, PositionHash> known;
  for (const auto& triangle : part.triangles) {
    auto& corners = piece.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& p = triangle[k];
      const auto [found, is_new] = known.emplace(p, static_cast<std::uint32_t>(piece.vertices.size()));
      if (is_new) piece.vertices.push_back(y_is_up ? Vec3{p.x, -p.z, p.y} : p);
      corners[k] = found->second;
    }
  }
  return piece;
}

// Each pattern is compared with each name, in a time of up to the product of their lengths.
void expect_few_comparisons(const MeshTriangles& triangles,
                            const std::vector<std::pair<std::string, MaterialId>>& materials,
                            const std::filesystem::path& file, const std::string& where) {
  constexpr std::size_t most = 1'000'000'000;
  std::size_t patterns = 0, names = 0;
  for (const auto& [pattern, material] : materials) patterns += pattern.size() + 1;
  for (const MeshTriangles::OfMaterial& part : triangles.all()) names += part.name.size() + 1;
  if (names > 0 && patterns > most / names)
    throw InputError(
        where,
        fmt::format("'materials' has patterns with {} characters for the {} characters of the names in '{}'",
                    grouped(patterns), grouped(names), file.string()),
        fmt::format("use fewer patterns; the product of both is at most {}", grouped(most)));
}

[[noreturn]] void fail_unmatched(const std::set<std::string>& names, const std::filesystem::path& file,
                                 const std::string& where) {
  std::vector<std::string_view> list(names.begin(), names.end());
  const bool has_unnamed = list.front().empty();
  if (has_unnamed) list.erase(list.begin());
  if (list.empty())
    throw InputError(where, fmt::format("surfaces of '{}' have no material", file.string()),
                     "add an entry \"*\" to 'materials', which matches all surfaces");
  throw InputError(where,
                   fmt::format("no entry of 'materials' matches these materials of '{}': {}{}", file.string(),
                               shortened(join(list, ", "), 300),
                               has_unnamed ? ", or the surfaces without a material" : ""),
                   "add an entry for each, e.g. \"*\"");
}

// The file, settings and materials of a mesh. Empty if the file may change again unnoticed.
std::string description_of(const InputFile& input, std::optional<bool> y_is_up,
                           const std::vector<std::pair<std::string, MaterialId>>& materials) {
  const struct stat& state = input.state();
  const std::int64_t modified = ns_of(state.st_mtim), changed = ns_of(state.st_ctim);
  if (!is_settled(modified)) return "";
  std::string text = fmt::format("{} {} {} {} {} {} {}", state.st_dev, state.st_ino, state.st_size, modified,
                                 changed, y_is_up ? static_cast<int>(*y_is_up) : -1, in_quotes(input.name()));
  for (const auto& [pattern, material] : materials)
    text += fmt::format(" {}:{}={}", pattern.size(), pattern, material.value);
  return text;
}

ImportedMesh read_mesh(const InputFile& input, const std::filesystem::path& name, const StoreFolder& folder,
                       std::optional<bool> y_is_up,
                       const std::vector<std::pair<std::string, MaterialId>>& materials,
                       const std::string& where) {
  const std::filesystem::path& file = input.path();
  const std::string extension = lower_case(file.extension().string());
  const bool is_gltf = extension == ".gltf" || extension == ".glb";
  if (!is_gltf && extension != ".obj" && extension != ".stl" && extension != ".ply")
    throw InputError(where, fmt::format("the mesh '{}' does not have a known file extension", file.string()),
                     "use glTF (.gltf, .glb), OBJ (.obj), STL (.stl) or PLY (.ply)");
  const std::string content = input.read(max_mesh_file);
  // During the conversion to pieces, memory contains all triangles twice and an index of their corners.
  MeshTriangles triangles(folder.memory() / 4);
  MeshLines lines(content, file, where);
  if (is_gltf) read_gltf(lines, name, folder, triangles);
  if (extension == ".obj") read_obj(lines, triangles);
  if (extension == ".stl") read_stl(lines, triangles);
  if (extension == ".ply") read_ply(lines, triangles);

  expect_few_comparisons(triangles, materials, file, where);
  ImportedMesh mesh;
  mesh.is_whole = !is_gltf || content.find("\"uri\"") == std::string::npos;
  std::set<std::string> unmatched;
  for (const MeshTriangles::OfMaterial& part : triangles.all()) {
    if (part.triangles.empty()) continue;
    MeshPiece piece = piece_of(part, y_is_up.value_or(is_gltf));
    if (const auto material = mapped(piece.name, materials)) {
      piece.material = *material;
      mesh.pieces.push_back(std::move(piece));
    } else {
      unmatched.insert(piece.name);
    }
  }
  if (!unmatched.empty()) fail_unmatched(unmatched, file, where);
  if (mesh.pieces.empty())
    throw InputError(where, fmt::format("the mesh '{}' has no triangles", file.string()), "check the file");
  for (const std::string& note : triangles.notes())
    mesh.notes.push_back(fmt::format("the mesh '{}' {}", name.string(), note));
  return mesh;
}

}  // namespace

ImportedMesh import_mesh(const std::filesystem::path& name, const StoreFolder& folder,
                         std::optional<bool> y_is_up,
                         const std::vector<std::pair<std::string, MaterialId>>& materials,
                         const std::string& where) {
  const InputFile input = folder.find(name, where, "mesh");
  const auto read = [&] { return read_mesh(input, name, folder, y_is_up, materials, where); };
  ReadCache* const cache = folder.cache();
  if (cache == nullptr) return read();
  const std::string description = description_of(input, y_is_up, materials);
  if (description.empty()) return read();
  if (const ImportedMesh* const known = cache->mesh(description)) return *known;
  ImportedMesh mesh = read();
  if (mesh.is_whole) cache->store(description, mesh);
  return mesh;
}

}  // namespace shelfbeam
