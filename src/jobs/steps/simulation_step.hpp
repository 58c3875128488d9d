#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>

#include <nlohmann/json_fwd.hpp>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/signal/checkpoint/result_log.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/transport/run/simulation_options.hpp"
#include "shelfbeam/transport/run/simulation_summary.hpp"

namespace shelfbeam::jobs {

/// States of a changing shop to be simulated.
struct WantedStates {
  std::uint32_t states = 0;  ///< 0: the shop as the file gives it
  std::size_t hard_labels = 1000;
  bool for_plan = false;  ///< simulate_planning_states, with reflectances at the low ends of their ranges
};

/// Reserves the signal file of a simulation. Throws InputError if it is the store file or another process
/// uses it, OutputError if it cannot be written or the disk has no room.
std::unique_ptr<OutputLock> reserve_output(const std::filesystem::path& output,
                                           const std::filesystem::path& store, const Scene& scene,
                                           const SimulationOptions& options);

/// The store of state k, from the text that 'inspect --state' writes, so that the simulation of this text has
/// the same bytes. Throws InputError without a section "variation".
Store store_in_state(const Store& store, const Scene& nominal, std::uint64_t seed, std::uint64_t k);

/// Throws as simulate_states. `log` then has all finished states.
StoredSignals simulate_wanted(const Store& store, const Scene& scene, const SimulationOptions& options,
                              const WantedStates& wanted, ResultLog& log, const RunControl& control);

nlohmann::ordered_json to_json(const SimulationSummary& summary);

}  // namespace shelfbeam::jobs
