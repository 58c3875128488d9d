#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/scenarios/scenario_table.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/states/store_states.hpp"
#include "shelfbeam/signal/checkpoint/result_log.hpp"
#include "shelfbeam/signal/parts/sampled_states.hpp"
#include "shelfbeam/transport/run/simulation_options.hpp"
#include "shelfbeam/transport/states/simulate_states.hpp"

namespace shelfbeam {

/// The states of a sample.
struct SampleStates {
  std::uint32_t count = 100;
  std::uint32_t batches = 4;                   ///< of each label in each state
  std::optional<Cause> only = {};              ///< changes alone; Cause::reflectance: nothing changes
  std::string_view purpose = planning_states;  ///< of simulate_states
  const SampledStates* sampled = nullptr;      ///< these states, if they are simulated already
};

/// The states on which units are placed, simulated part by part: all candidates for the labels that decide,
/// and some units for all labels. Most labels never decide: they receive more than enough from any placement
/// that serves the others.
class StateSample {
 public:
  /// `scene` is that of `states`. All references must outlive the object.
  StateSample(const StoreStates& states, const Scene& scene, const SimulationOptions& options,
              const SampleStates& which, ResultLog& log, const RunControl& control)
      : states_(states), scene_(scene), options_(options), which_(which), log_(log), control_(control) {}

  std::uint32_t count() const { return which_.count; }
  std::uint32_t batches() const { return which_.batches; }

  /// Sets the rows of a table from `first` on, which are those of `labels`. Throws as `simulate_states`.
  void fill(ScenarioTable& table, std::span<const LabelId> labels, std::size_t first) const;

  /// The signals that some labels receive from units, by label and state. Throws as `simulate_states`.
  std::vector<double> received(std::span<const LabelId> labels, std::span<const ColumnId> units,
                               const PlacementProblem& problem) const;

 private:
  // All units, or some.
  void signals(std::span<const LabelId> labels, std::optional<std::span<const ColumnId>> units,
               const std::function<void(const StateSignals&)>& use) const;
  void simulate(const Scene& part, const std::function<void(const StateSignals&)>& use) const;

  const StoreStates& states_;
  const Scene& scene_;
  const SimulationOptions& options_;
  SampleStates which_;
  ResultLog& log_;
  const RunControl& control_;
};

}  // namespace shelfbeam
