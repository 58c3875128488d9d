#include "shelfbeam/scene/build/mesh_facts.hpp"

#include <algorithm>

#include "shelfbeam/math/box_index.hpp"
#include "shelfbeam/scene/mesh/mesh_import.hpp"
#include "shelfbeam/scene/store_folder.hpp"

namespace shelfbeam {

MeshFacts mesh_facts(const std::filesystem::path& folder, const std::filesystem::path& name,
                     const StoreLimits& limits) {
  const StoreFolder store(folder, limits);
  const ImportedMesh mesh = import_mesh(name, store, {}, {{"*", MaterialId{0}}}, name.string());
  MeshFacts facts;
  Bounds bounds;
  for (const MeshPiece& piece : mesh.pieces) {
    for (const Vec3& vertex : piece.vertices) bounds.include(vertex);
    const auto known = std::ranges::find(facts.materials, piece.name, &MeshFacts::Material::name);
    if (known == facts.materials.end())
      facts.materials.push_back({piece.name, piece.triangles.size()});
    else
      known->triangles += piece.triangles.size();
  }
  facts.low = bounds.low;
  facts.high = bounds.high;
  return facts;
}

}  // namespace shelfbeam
