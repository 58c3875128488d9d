#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/plan/plan.hpp"
#include "shelfbeam/plan/store/plan_request.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

struct Store;

/// Results that another run has already simulated, and the files by which an interrupted plan continues.
struct PlanInputs {
  std::optional<StoredSignals> signals = {};        ///< reused if they fit (fitting_signals)
  std::vector<std::filesystem::path> sampled = {};  ///< parts of the states on which units are placed
  CheckpointOptions checkpoint = {};                ///< of the simulation
  std::filesystem::path states_checkpoint = {};     ///< of the states
};

/// The simulation of a request.
SimulationOptions simulation_of(const PlanRequest& request, const CheckpointOptions& checkpoint = {});

/// The states on which a request places units; 0 for the shop as the file gives it.
std::uint32_t states_of(const PlanRequest& request, const Store& store);

/// The table of a matrix with the constraints of a request. `name`: of the matrix in errors.
SignalTable table_of(const PlanRequest& request, const SignalMatrix& matrix, const std::string& name);

/// Throws InputError, with the setting, for a request that does not fit the store, before any long work.
/// `name`: of the store in errors.
void check_request(const PlanRequest& request, const PlanInputs& inputs, const Store& store,
                   const Scene& scene, const std::string& name);

/// Plans a store: a fixed shop by `make_plan`, and a shop that changes by `plan_over_states` from the plan
/// for the shop as the file gives it. `scene` is that of the store. Throws as `check_request` and as the
/// parts. Interrupted, it ends with the results so far.
Plan plan_store(const Store& store, const Scene& scene, const PlanRequest& request, PlanInputs inputs = {},
                const RunControl& control = {}, const std::string& name = "store");

/// As `plan_store`, for a request that `check_request` has accepted.
Plan plan_checked(const Store& store, const Scene& scene, const PlanRequest& request, PlanInputs inputs,
                  const RunControl& control, const std::string& name);

}  // namespace shelfbeam
