#pragma once

#include <cmath>

#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam::test {

/// A black room with one point unit of 1 W/sr at 45 degrees and one cosine label; tests set their positions.
inline Scene empty_room(const Vec3& size) {
  Scene scene;
  scene.room = RoomShape::box(size);
  scene.upper = size;
  scene.materials = {{"black", make_lambertian(0)}};
  LabelType label_type;
  label_type.name = "label";
  label_type.threshold = 1;
  scene.label_types = {label_type};
  TransceiverType unit_type;
  unit_type.name = "unit";
  scene.transceiver_types = {unit_type};
  scene.labels = {{"L", size * 0.5, {0, 0, 1}, {}}};
  scene.transceivers = {{}};
  scene.transceivers[0].id = "T";
  scene.transceivers[0].position = size * 0.75;
  for (int corner = 0; corner < 8; ++corner)
    scene.mesh.vertices.push_back(
        {(corner & 1) != 0 ? size.x : 0, (corner & 2) != 0 ? size.y : 0, (corner & 4) != 0 ? size.z : 0});
  scene.mesh.triangles = {{0, 2, 4}, {2, 6, 4}, {1, 5, 3}, {3, 5, 7}, {0, 4, 1}, {1, 4, 5},
                          {2, 3, 6}, {3, 7, 6}, {0, 1, 2}, {1, 3, 2}, {4, 6, 5}, {5, 6, 7}};
  scene.mesh.materials.assign(12, MaterialId{0});
  return scene;
}

/// Assigns a material to the side of the room in this direction.
inline void give_side(Scene& scene, const Vec3& direction, MaterialId material) {
  for (std::size_t t = 0; t < scene.mesh.triangles.size(); ++t) {
    double along = 0;
    for (const std::uint32_t corner : scene.mesh.triangles[t])
      along += dot(scene.mesh.vertices[corner] - scene.room->upper() * 0.5, direction) / 3;
    if (along > 0.49 * std::abs(dot(scene.room->upper(), direction))) scene.mesh.materials[t] = material;
  }
}

}  // namespace shelfbeam::test
