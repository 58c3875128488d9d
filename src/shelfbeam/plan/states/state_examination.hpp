#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/problem/placement_problem.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/states/store_states.hpp"
#include "shelfbeam/signal/checkpoint/result_log.hpp"
#include "shelfbeam/transport/run/prepared_scene.hpp"
#include "shelfbeam/transport/run/simulation_options.hpp"

namespace shelfbeam {

/// Verdicts on mounted units in single states.
///
/// A label counts as reached in a state if the lower confidence limit of its signal at the level
/// `verdict_error` meets its requirement. A state in which it is missed so counts as reached with at most
/// this probability, and a label that is missed in a share q of the states is counted as missed in at least
/// (1 - verdict_error) q of them on average.
class StateExamination {
 public:
  static constexpr double verdict_error = 0.1;

  /// `units`: the scene of `states` with the mounted units only. `log` keeps the results. All references must
  /// outlive the object.
  StateExamination(const StoreStates& states, const Scene& units, const PlacementProblem& problem,
                   const SimulationOptions& options, ResultLog& log, const RunControl& control);

  /// The labels that do not count as reached in state k, ascending. Throws as `sample_batches`.
  std::vector<LabelId> missed(std::uint64_t k) const;

 private:
  std::vector<LabelId> simulated(std::uint64_t k) const;

  const StoreStates& states_;
  const Scene& units_;
  PlacementProblem problem_;
  SimulationOptions options_;
  ResultLog& log_;
  std::uint64_t key_;  ///< of the units and the problem
  RunControl control_;
  std::unique_ptr<const PreparedScene> first_;
  std::vector<LabelId> labels_;
};

}  // namespace shelfbeam
