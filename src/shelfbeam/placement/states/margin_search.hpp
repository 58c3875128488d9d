#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/states/state_table.hpp"

namespace shelfbeam {

/// Selections for the mean signals of the states, with requirements raised by a margin of each label.
///
/// The margin of a label is a ratio of its signals from the last selection: the mean over the states, over
/// the signal below which as many of them fall as misses are allowed. It settles after few selections,
/// because similar selections serve a label similarly.
class MarginSearch {
 public:
  /// All references must outlive the object.
  MarginSearch(const StateTable& states, const PlacementProblem& problem, const MissAllowance& allowance);

  /// The next selection; empty if there is none. `seconds`: time limit.
  std::vector<std::uint32_t> next(double seconds, const PlaceOptions& options, const RunControl& control);

 private:
  void adapt(const std::vector<std::uint32_t>& selected);

  const StateTable& states_;
  const PlacementProblem& problem_;
  const MissAllowance& allowance_;
  SignalTable mean_;
  std::vector<double> margin_;
};

}  // namespace shelfbeam
