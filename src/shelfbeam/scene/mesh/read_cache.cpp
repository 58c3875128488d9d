#include "shelfbeam/scene/mesh/read_cache.hpp"

#include <cstddef>
#include <utility>

namespace shelfbeam {

const Material& ReadCache::material(const std::string& description, const std::function<Material()>& make) {
  constexpr std::size_t most = 1000;
  if (const auto found = materials_.find(description); found != materials_.end()) return found->second;
  Material made = make();
  if (materials_.size() == most) materials_.clear();
  return materials_.emplace(description, std::move(made)).first->second;
}

const ImportedMesh* ReadCache::mesh(const std::string& description) const {
  const auto found = meshes_.find(description);
  return found == meshes_.end() ? nullptr : &found->second;
}

void ReadCache::store(const std::string& description, const ImportedMesh& mesh) {
  constexpr std::size_t most = std::size_t{1} << 26;  // bytes
  std::size_t bytes = 1000 + description.size();
  for (const MeshPiece& piece : mesh.pieces)
    bytes += piece.vertices.size() * sizeof(Vec3) + piece.triangles.size() * sizeof(piece.triangles[0]);
  if (bytes > most / 2) return;
  if (mesh_bytes_ + bytes > most) {
    meshes_.clear();
    mesh_bytes_ = 0;
  }
  if (meshes_.emplace(description, mesh).second) mesh_bytes_ += bytes;
}

}  // namespace shelfbeam
