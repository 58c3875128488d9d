#pragma once

#include <cstdint>

#include "shelfbeam/transport/operator/surface_field.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam {

/// The surroundings of a unit, by rays of its emission.
struct UnitSurvey {
  double near = 0;        ///< share of its light that meets a surface within a hand's breadth
  double bent = 0;        ///< share that meets mirrors, glass or metal first
  double unexplored = 0;  ///< share that meets surfaces without a cell
  double unseen = 0;      ///< share that meets cells that no ray from a label meets
};

/// The unit is the only one of `probe`. `seen`: by cell, whether rays from labels meet it.
UnitSurvey survey_unit(const World& probe, const SurfaceNodes& nodes, const std::vector<std::uint8_t>& seen,
                       std::uint64_t seed);

}  // namespace shelfbeam
