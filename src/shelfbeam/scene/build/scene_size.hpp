#pragma once

#include <cstddef>
#include <vector>

#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// The size of a scene to which fixtures are being added.
struct SceneSize {
  std::size_t vertices, triangles, fixtures, parts, labels;
  std::vector<double> areas;

  explicit SceneSize(const Scene& scene)
      : vertices(scene.mesh.vertices.size()),
        triangles(scene.mesh.triangles.size()),
        fixtures(scene.fixtures.size()),
        parts(scene.parts.size()),
        labels(scene.labels.size()),
        areas(scene.areas) {}

  /// Removes the surfaces that were added since.
  void restore_surfaces(Scene& scene) const {
    scene.mesh.vertices.resize(vertices);
    scene.mesh.triangles.resize(triangles);
    scene.mesh.materials.resize(triangles);
  }
  /// Removes everything that was added since.
  void restore(Scene& scene) const {
    restore_surfaces(scene);
    scene.fixtures.resize(fixtures);
    scene.parts.resize(parts);
    scene.labels.resize(labels);
    scene.areas = areas;
  }
};

}  // namespace shelfbeam
