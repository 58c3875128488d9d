#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "shelfbeam/plan/sub_scene.hpp"
#include "shelfbeam/scene/states/store_states.hpp"
#include "shelfbeam/signal/checkpoint/checkpoint.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/transport/run/simulate.hpp"
#include "shelfbeam/transport/states/simulate_states.hpp"

#include "jobs/steps/simulation_step.hpp"
#include "python/bind.hpp"
#include "python/request.hpp"
#include "python/shop.hpp"
#include "python/work.hpp"

namespace py = pybind11;
namespace fs = std::filesystem;

namespace shelfbeam::python {

namespace {

// Options of `simulate` that a job does not have.
struct Extras {
  bool by_bounce = false;
  std::optional<double> by_length;
  std::optional<std::uint32_t> lengths;
  jobs::WantedStates states;
  std::optional<std::vector<std::uint32_t>> labels, units;  // numbers; none: all
};

struct Simulated {
  std::shared_ptr<StoredSignals> signals;
  std::string summary;  // JSON; empty for states
};

SimulationOptions options_of(const Call& call, const Extras& extras, const fs::path& output) {
  SimulationRequest request = call.job.plan.simulation;
  request.default_direct = DirectLight::sampled;
  request.by_bounce = extras.by_bounce;
  request.by_length = extras.by_length;
  request.lengths = extras.lengths;
  CheckpointOptions checkpoint = call.job.checkpoint;
  if (!output.empty()) checkpoint.path = checkpoint_path(output);
  return request.options(call.job.plan.seed, std::move(checkpoint));
}

Simulated simulate_states_of(const Shop& shop, const Call& call, const SimulationOptions& options,
                             const Extras& extras, const fs::path& output, const RunControl& control) {
  Store store = shop.store;
  store.cancel = control.cancel;
  leave_out(store, call.job.without);
  ResultLog log = log_of_states(options.checkpoint.path, shop.scene.store_hash, options);
  try {
    auto signals = std::make_shared<StoredSignals>(
        jobs::simulate_wanted(store, shop.scene, options, extras.states, log, control));
    if (!output.empty()) {
      write_signal_file(*signals, output);
      remove_checkpoint(options.checkpoint.path);
    }
    return {std::move(signals), {}};
  } catch (const Interrupted&) {
    log.flush();
    throw;
  }
}

Simulated simulate_shop(const Shop& shop, const Call& call, const Extras& extras, const fs::path& output,
                        const RunControl& control) {
  jobs::expect_no_warnings(shop.scene, call.job.strict);
  const SimulationOptions options = options_of(call, extras, output);
  if (extras.states.states > 0) return simulate_states_of(shop, call, options, extras, output, control);
  if (!output.empty()) {
    const SimulationSummary summary = simulate_to_file(shop.scene, options, output, control);
    return {std::make_shared<StoredSignals>(read_signal_file(output)), jobs::to_json(summary).dump()};
  }
  SimulationResult result;
  if (extras.labels || extras.units) {
    const auto or_all = [](const auto& chosen, std::size_t count) {
      return chosen ? *chosen : all_numbers(count);
    };
    const Scene part = sub_scene(shop.scene, or_all(extras.labels, shop.scene.labels.size()),
                                 or_all(extras.units, shop.scene.transceivers.size()));
    result = simulate(part, options, control);
  } else {
    result = simulate(shop.scene, options, control);
  }
  return {std::make_shared<StoredSignals>(StoredSignals{std::move(result.matrix)}),
          jobs::to_json(result.summary).dump()};
}

py::tuple simulated(const std::shared_ptr<Shop>& shop, const std::string& options, const py::object& progress,
                    const py::dict& more, const fs::path& output) {
  const Call call(options, progress);
  const auto value = [&]<class T>(const char* key, T& to) {
    if (more.contains(key) && !more[key].is_none()) to = more[key].cast<T>();
  };
  Extras extras;
  value("by_bounce", extras.by_bounce);
  value("by_length", extras.by_length);
  value("lengths", extras.lengths);
  value("states", extras.states.states);
  value("hard_labels", extras.states.hard_labels);
  value("for_plan", extras.states.for_plan);
  value("labels", extras.labels);
  value("units", extras.units);
  Simulated result = watched(call.threads(), progress, [&](const RunControl& control) {
    return simulate_shop(*shop, call, extras, output, control);
  });
  return py::make_tuple(std::move(result.signals), std::move(result.summary));
}

}  // namespace

void bind_simulation(py::module_& module) {
  module.def("simulate", simulated);
}

}  // namespace shelfbeam::python
