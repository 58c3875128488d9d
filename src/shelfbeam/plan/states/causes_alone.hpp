#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/plan/answer/availability.hpp"
#include "shelfbeam/plan/states/state_sample.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam {

/// Each cause of a shop's changes alone: sampled states in which it is as in states 0, 1, ... and all else as
/// in the file, also reflectances. For reflectances, there is one state, with all of them at the low ends of
/// their ranges and nothing else changed.
class CausesAlone {
 public:
  static constexpr std::uint32_t max_states = 40;  ///< per cause: all causes take a fifth of a usual run

  /// `scene` is that of the store, with all candidates, `table` the table of its labels and candidates;
  /// `found` gives goal and required availabilities. All references must outlive the object.
  CausesAlone(const Store& store, const Scene& scene, const SignalTable& table,
              const PlacementProblem& problem, const Availability& found, const SimulationOptions& options,
              std::uint32_t states, ResultLog& log, const RunControl& control);

  /// Sets Availability::alone and missed_as_given for some columns. With `place`, finds the units that each
  /// cause alone needs; its time limit is that of all causes together. Throws as `simulate_states`.
  void examine(std::span<const ColumnId> selected, const std::optional<PlaceOptions>& place,
               Availability& found) const;

  /// Which causes make some columns miss each of these labels in all of their states; "none" if the columns
  /// miss it in the shop as the file gives it.
  std::vector<LostLabel> lost(std::span<const LabelId> labels, std::span<const ColumnId> selected) const;

 private:
  struct Part {
    std::optional<Cause> cause;  ///< nothing: the shop as the file gives it
    std::string purpose;
  };
  static const Part as_given;
  std::vector<Part> causes() const;
  StateSample sample(const Part& part) const;
  MissAllowance allowance(std::span<const LabelId> labels, std::uint32_t states) const;

  Scene scene_, low_scene_;
  Store low_store_;
  StoreStates states_, low_states_;
  const SignalTable& table_;
  const PlacementProblem& problem_;
  const Availability& found_;
  const SimulationOptions& options_;
  std::uint32_t count_;
  ResultLog& log_;
  const RunControl& control_;
};

}  // namespace shelfbeam
