#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "shelfbeam/placement/mip/mip.hpp"

namespace shelfbeam::detail {

/// The most labels that at most `units` units reach, as a MIP: the rows of CoverModel with a variable u_i
/// that pays for label i when it is missed; u_i costs more than all units together, so that the fewest labels
/// are missed first and fewest units are used second.
class ReachModel {
 public:
  /// False where the model would be too large to be solved to the end.
  static bool fits(const SignalTable& table, const Question& question);

  ReachModel(const SignalTable& table, const Question& question, std::size_t units);

  struct Outcome {
    std::optional<std::vector<std::uint32_t>> selected;  ///< allowed, of at most `units` units
    std::size_t most_reached = 0;                        ///< no selection reaches more
    bool failed = false;  ///< the solver failed or contradicted itself; `most_reached` can still be relied on
  };
  Outcome solve(const SolveFunction& solve, double time_limit_s, const RunControl& control);

 private:
  void add_label(std::size_t label);
  void cut_off(const std::vector<std::uint32_t>& selected, std::size_t unmet_label);

  const SignalTable& table_;
  Question question_;
  std::size_t units_;
  milp::Model model_;
};

}  // namespace shelfbeam::detail
