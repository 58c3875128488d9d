#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/scene/states/store_states.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/transport/run/prepared_scene.hpp"
#include "shelfbeam/transport/run/simulation_options.hpp"

namespace shelfbeam {

/// The states to simulate, by their numbers.
struct StateRange {
  std::uint32_t first = 0, count = 100;
  std::uint32_t batches = 4;  ///< of each label in each state, at least 2
};

/// The signals of one state, multiplied by the relative sensitivities of the labels, so that the requirements
/// of the nominal shop apply.
struct StateSignals {
  std::uint32_t state = 0;
  const SignalLayer& signals;
};

/// Simulates the shop in some states, one after another, with few samples: the spread between states is many
/// times the noise of one. `first` is the prepared nominal scene, whose radiance cache all states share. The
/// signals of a state depend on the store, its number and the options only. Throws as `sample_batches`.
void simulate_states(const StoreStates& states, const PreparedScene& first, const SimulationOptions& options,
                     const StateRange& range, const std::function<void(const StateSignals&)>& use,
                     const RunControl& control = {});

/// The same with all results in memory: SignalMatrix::by_state and their mean. `scene` is that of the store.
SignalMatrix simulate_states(const Store& store, const Scene& scene, const SimulationOptions& options,
                             const StateRange& range, const RunControl& control = {});

}  // namespace shelfbeam
