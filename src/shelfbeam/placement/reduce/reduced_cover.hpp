#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/mip/mip.hpp"
#include "shelfbeam/placement/problem/instance.hpp"
#include "shelfbeam/placement/reduce/reductions.hpp"

namespace shelfbeam::detail {

struct ReducedAnswer {
  std::optional<std::vector<std::uint32_t>> selected;  ///< ascending; not yet checked
  double bound = -milp::infinity;                      ///< no answer costs less
  bool proven = false;
  bool failed = false;  ///< the solver's answers could not be relied on; what is here still can
};

/// Lets a MIP solver do what is left of a non-cooperative question (reduce_cover), part by part. `cost` is
/// what is minimised. Answers without `left_out` are looked for; the bound is theirs, infinite where there
/// are none.
ReducedAnswer place_reduced(const SignalTable& table, const Question& question, std::span<const double> cost,
                            const Reduction& reduction, std::span<const std::uint32_t> left_out,
                            const SolveFunction& solve, double time_limit_s, const RunControl& control);

/// The least `cost` among the selections that meet every label and have as many units as `start`, which is
/// one of them.
ReducedAnswer place_at_count(const SignalTable& table, const Question& question, std::span<const double> cost,
                             const std::vector<std::uint32_t>& start, const SolveFunction& solve,
                             double time_limit_s, const RunControl& control);

}  // namespace shelfbeam::detail
