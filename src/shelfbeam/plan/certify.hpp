#pragma once

#include <cstdint>
#include <functional>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/certificate.hpp"
#include "shelfbeam/placement/placement.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/signal/signal_table.hpp"
#include "shelfbeam/transport/simulation_options.hpp"

namespace shelfbeam {

struct CertifyOptions {
  double confidence = 0.99;
  double budget_s = 600;         ///< for all that comes after the first placement
  SimulationOptions simulation;  ///< estimator, seed, memory
  PlaceOptions place;
};

/// Verifies units that hang already, all transceivers of the scene, in rounds as `certify` does: the
/// certificate of the placement that is returned says nothing of a bound. Which links must do where units do
/// not cooperate is decided on a simulation of its own. Throws as `simulate`.
Placement verify_installation(const Scene& scene, const Question& question, const CertifyOptions& options,
                              const RunControl& control = {});

/// Makes the table that is placed on: the matrix with its side constraints.
using TableRule = std::function<SignalTable(const SignalMatrix&)>;

/// Carries the error of sampling through to the decision (docs/methods/certified_plan.md). In rounds
/// r = 1, 2, ..., each with random numbers of its own and at level (1 - confidence) / 2^r:
/// - the selected units are simulated afresh, and every label is called reached, missed or undecided
///   (verification.hpp),
/// - fresh upper limits of a few labels' signals must need as many units as the placement has (optimism.hpp),
/// - labels that are not reached get more samples for all candidates, which go into `matrix`, and `placement`
///   is made anew.
/// It ends when both statements hold, with the budget, when cancelled, or where a label is so near its
/// requirement that the budget could not decide it. `matrix` and `placement` fit each other at any time.
///
/// The bound is of the number of units; prices and second objectives are those of the matrix. Throws as
/// `sample_batches`, but not for being interrupted.
Certificate certify(const Scene& scene, const TableRule& table, const CertifyOptions& options,
                    SignalMatrix& matrix, Placement& placement, const RunControl& control = {});

}  // namespace shelfbeam
