#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/instance.hpp"
#include "shelfbeam/placement/mip.hpp"

namespace shelfbeam::detail {

struct ReducedAnswer {
  std::optional<std::vector<std::uint32_t>> selected;  ///< ascending; not yet checked
  double bound = -milp::infinity;                      ///< no answer costs less
  bool proven = false;
};

/// Non-cooperative questions: reduces them (reductions.hpp) and lets a MIP solver do what is left, part by
/// part. `cost` is what is minimised.
ReducedAnswer place_reduced(const SignalTable& table, const Question& question, std::span<const double> cost,
                            const milp::Backend& backend, double time_limit_s, const RunControl& control);

/// The least `cost` among the selections that meet every label and have as many units as `start`, which is
/// one of them.
ReducedAnswer place_at_count(const SignalTable& table, const Question& question, std::span<const double> cost,
                             const std::vector<std::uint32_t>& start, const SolveFunction& solve,
                             double time_limit_s, const RunControl& control);

}  // namespace shelfbeam::detail
