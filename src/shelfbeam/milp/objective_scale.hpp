#pragma once

#include <span>

#include "shelfbeam/milp/model.hpp"

namespace shelfbeam::milp::detail {

/// A power of two that brings the largest cost between 512 and 1024, so that solvers' absolute tolerances on
/// costs (1e-7 and the like) never decide; 1 for whole-numbered costs, whose integrality solvers use.
double objective_scale(std::span<const Column> columns);

}  // namespace shelfbeam::milp::detail
