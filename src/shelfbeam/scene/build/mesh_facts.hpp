#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/scene/read_scene.hpp"

namespace shelfbeam {

/// What a mesh file contains, in its own unit of length, with z up as its format defines by default.
struct MeshFacts {
  struct Material {
    std::string name;  ///< empty for surfaces without one
    std::size_t triangles = 0;
  };

  Vec3 low, high;  ///< opposite corners of its extent
  std::vector<Material> materials;
};

/// Of a mesh file in a folder. Throws InputError as for a mesh of a store file there.
MeshFacts mesh_facts(const std::filesystem::path& folder, const std::filesystem::path& name,
                     const StoreLimits& limits = {});

}  // namespace shelfbeam
