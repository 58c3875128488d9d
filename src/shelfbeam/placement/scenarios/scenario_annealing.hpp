#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/kernels/search_matrix.hpp"
#include "shelfbeam/placement/problem/effort.hpp"
#include "shelfbeam/placement/scenarios/scenario_table.hpp"

namespace shelfbeam {

/// Simulated annealing over cases, a label in a scenario each: the lack of a selection omits the cases that
/// the allowance covers, those that lack most, and is counted on cases that some selection missed or nearly
/// missed.
class ScenarioAnnealing {
 public:
  /// All references must outlive the object. Precondition: there is a scenario.
  ScenarioAnnealing(const ScenarioTable& scenarios, const PlacementProblem& problem,
                    const MissAllowance& allowance);

  /// A selection of fewer units than `start` that keeps to the allowance with `reserve` times all
  /// requirements, or of at most as many if the start does not, at no higher price. nullopt if none was found
  /// within the effort. Every call has other random numbers.
  std::optional<Selection> next(const Selection& start, double reserve, const detail::Effort& effort,
                                const RunControl& control);
  /// Some unit may be exchanged for another candidate.
  bool can_exchange(const Selection& selected) const { return instance_.can_exchange(selected); }
  /// A selection of as many units, at no higher price, that keeps to the allowance with the largest reserve
  /// that is found in time, up to 1.2 times all requirements.
  Selection spread(Selection selected, const detail::Effort& effort, const RunControl& control);

 private:
  const ScenarioTable& scenarios_;
  const PlacementProblem& problem_;
  const MissAllowance& allowance_;
  SignalTable first_;  ///< the first scenario
  detail::Instance instance_;
  detail::SearchMatrix matrix_;
  std::uint32_t seed_ = 1;
};

}  // namespace shelfbeam
