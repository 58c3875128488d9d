#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/plan/states/goal_rules.hpp"
#include "shelfbeam/plan/sub_scene.hpp"
#include "shelfbeam/scene/states/store_states.hpp"
#include "shelfbeam/signal/checkpoint/checkpoint.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/transport/run/simulate.hpp"
#include "shelfbeam/transport/states/simulate_states.hpp"

#include "jobs/plan_job_json.hpp"
#include "jobs/steps/simulation_step.hpp"
#include "python/bind.hpp"
#include "python/shop.hpp"
#include "python/work.hpp"

namespace py = pybind11;
namespace fs = std::filesystem;

namespace shelfbeam::python {

namespace {

// Options of `simulate` that a job does not have. The package checks which of them go together.
struct Extras {
  bool by_bounce = false;
  std::optional<double> by_length;
  std::optional<std::uint32_t> lengths;
  jobs::WantedStates states;
  std::optional<std::vector<LabelId>> labels;  // none: all
  std::optional<std::vector<ColumnId>> units;  // none: all

  explicit Extras(const py::dict& more) {
    read(more, "by_bounce", by_bounce);
    read(more, "by_length", by_length);
    read(more, "lengths", lengths);
    read(more, "states", states.states);
    read(more, "hard_labels", states.hard_labels);
    read(more, "for_plan", states.for_plan);
    read(more, "labels", labels);
    read(more, "units", units);
  }

 private:
  template <class T>
  static void read(const py::dict& more, const char* key, T& value) {
    if (!more.contains(key) || more[key].is_none()) return;
    try {
      value = more[key].cast<T>();
    } catch (const py::cast_error&) {
      throw InputError(key, "has a value of another kind: " + std::string(py::repr(more[key])), "correct it");
    }
  }
};

struct Simulated {
  std::shared_ptr<StoredSignals> signals;
  std::string summary;  // JSON; empty for states
};

SimulationOptions options_of(const jobs::PlanJob& job, const Extras& extras, const fs::path& output) {
  SimulationRequest request = job.plan.simulation;
  request.default_direct = DirectLight::sampled;
  request.by_bounce = extras.by_bounce;
  request.by_length = extras.by_length;
  request.lengths = extras.lengths;
  CheckpointOptions checkpoint = job.checkpoint;
  if (!output.empty()) checkpoint.path = checkpoint_path(output);
  return request.options(job.plan.seed, std::move(checkpoint));
}

Simulated simulate_states_of(const Shop& shop, const jobs::PlanJob& job, const SimulationOptions& options,
                             const Extras& extras, const fs::path& output, const RunControl& control) {
  Store store = shop.store;
  store.cancel = control.cancel;
  leave_out(store, job.without);
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

Simulated simulate_shop(const Shop& shop, const jobs::PlanJob& job, const Extras& extras,
                        const fs::path& output, const RunControl& control) {
  jobs::expect_no_warnings(shop.scene, job.strict);
  const SimulationOptions options = options_of(job, extras, output);
  if (extras.states.states == 0) expect_no_goal({}, job.without);
  std::unique_ptr<OutputLock> lock;
  if (!output.empty()) lock = jobs::reserve_output(output, job.store, shop.scene, options);
  if (extras.states.states > 0) return simulate_states_of(shop, job, options, extras, output, control);
  if (!output.empty()) {
    const SimulationSummary summary = simulate_to_file(shop.scene, options, output, control);
    return {std::make_shared<StoredSignals>(read_signal_file(output)), jobs::to_json(summary).dump()};
  }
  SimulationResult result;
  if (extras.labels || extras.units) {
    const auto or_all = [](const auto& chosen, std::size_t count) {
      if (chosen) expect_numbers(*chosen, count, "the simulation");
      if (chosen && chosen->empty())
        throw InputError("the simulation", "has no labels or no units", "choose some");
      using Number = typename std::decay_t<decltype(*chosen)>::value_type;
      return chosen ? *chosen : all_numbers<Number>(count);
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

py::tuple simulated(const Shop& shop, const std::string& options, const py::object& progress,
                    const py::dict& more, const fs::path& output) {
  const jobs::PlanJob job = jobs::parse_plan_job(options, "options");
  const Extras extras(more);
  Simulated result = watched(job.threads, progress, [&](const RunControl& control) {
    return simulate_shop(shop, job, extras, output, control);
  });
  return py::make_tuple(std::move(result.signals), std::move(result.summary));
}

}  // namespace

void bind_simulation(py::module_& module) {
  module.def("simulate", simulated);
}

}  // namespace shelfbeam::python
