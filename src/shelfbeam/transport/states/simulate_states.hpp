#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/scene/states/store_states.hpp"
#include "shelfbeam/signal/checkpoint/result_log.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/transport/run/prepared_scene.hpp"
#include "shelfbeam/transport/run/simulation_options.hpp"

namespace shelfbeam {

/// The states to simulate, by their numbers.
struct StateRange {
  std::uint64_t first = 0;
  std::uint32_t count = 100;
  std::uint32_t batches = 4;  ///< of each label in each state, at least 2
};

/// The signals of one state, multiplied by the sensitivities of the labels relative to those of the nominal
/// shop, whose requirements then apply.
struct StateSignals {
  std::uint64_t state = 0;
  const SignalLayer& signals;
};

using StateMaker = std::function<Store(std::uint64_t k)>;

/// Simulates the shop in some states, one after another, with few samples: the spread between states is many
/// times the noise of one. `first` is the prepared nominal scene, whose radiance cache all states share. The
/// signals of a state depend on the store, its number, the labels and candidates of `first`, and the options
/// only. `log` keeps finished states; `purpose` distinguishes simulations with other states of the same
/// labels and candidates. Throws as `sample_batches`.
void simulate_states(const StateMaker& states, const PreparedScene& first, const SimulationOptions& options,
                     const StateRange& range, const std::function<void(const StateSignals&)>& use,
                     ResultLog& log, std::string_view purpose, const RunControl& control = {});

/// The purpose of the states on which a plan places units.
inline constexpr std::string_view planning_states = "sample";

/// Mean, deviation, and the signals of the `max_hard` hardest labels, which the fewest candidates reach: the
/// sum of min(1, M_ij / requirement_i) over all candidates j, in the first of the states, is smallest. Memory
/// does not grow with the number of states otherwise. With `options.part`, simulates that part of the states
/// and keeps the signals of all labels in each, for `merge_parts`. `scene` is that of the store.
StoredSignals simulate_states(const Store& store, const Scene& scene, const SimulationOptions& options,
                              const StateRange& range, std::size_t max_hard, ResultLog& log,
                              const RunControl& control = {});

/// The states on which a plan places units (`options.part` of them), with the signals of all labels and their
/// errors, for SampledStates. `store` and `scene` have their reflectances as the plan assumes them.
StoredSignals simulate_planning_states(const Store& store, const Scene& scene,
                                       const SimulationOptions& options, const StateRange& range,
                                       ResultLog& log, const RunControl& control = {});

/// The part of a unit in the keys of a log.
std::string key_text(const Transceiver& unit);

/// The log of the states of a store, which an earlier run may have begun (`options.checkpoint`, whose path it
/// replaces). Throws as ResultLog.
ResultLog log_of_states(const std::filesystem::path& path, const std::string& store_hash,
                        const SimulationOptions& options);

}  // namespace shelfbeam
