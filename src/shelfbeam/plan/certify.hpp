#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/plan/answer/certificate.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"
#include "shelfbeam/transport/run/simulation_options.hpp"

namespace shelfbeam {

/// What rounds may take together: time or, so that the outcome is the same on every machine, work.
struct RoundBudget {
  double seconds = 600;
  std::optional<std::uint64_t> samples = {};  ///< instead: first rays, of all labels together
};

struct CertifyOptions {
  double confidence = 0.99;
  RoundBudget budget = {};            ///< for all that comes after the first placement
  SimulationOptions simulation = {};  ///< estimator, seed, memory
  PlaceOptions place = {};
};

/// Makes the table that is placed on: the matrix with its side constraints.
using TableRule = std::function<SignalTable(const SignalMatrix&)>;

/// What came of certifying a placement. The three fit each other: `placement` is made on `matrix`, and the
/// verdicts of `certificate` are of its selection.
struct Certified {
  SignalMatrix matrix;  ///< with the fresh samples that it has learned
  Placement placement;
  Certificate certificate;
};

/// Carries the error of sampling through to the decision (docs/methods/certified_plan.md). In rounds
/// r = 1, 2, ..., each with random numbers of its own and at level (1 - confidence) / 2^r:
/// - the selected units are simulated afresh, and every label is called reached, missed or undecided
///   (verification.hpp),
/// - fresh upper limits of a few labels' signals must need as many units as the placement has
/// (bound_rows.hpp),
/// - labels that are not reached get more samples for all candidates, which the matrix learns, and the
///   placement is made anew.
/// Where the matrix leaves labels unreachable, fresh upper limits of these must do so, too: they are missed
/// then, by whatever selection.
///
/// It ends when all is said, with the budget, when cancelled, or where a label is so near its requirement
/// that the budget could not decide it. A round that is interrupted leaves matrix and placement as they were.
/// Moved in, the matrix is never there twice.
///
/// With a budget in samples, and a step limit for placements, the outcome does not depend on the machine.
///
/// The bound is of the number of units; prices and second objectives are those of the matrix. Throws as
/// `sample_batches`, but not for being interrupted.
Certified certify(const Scene& scene, const TableRule& table, const CertifyOptions& options,
                  SignalMatrix matrix, Placement placement, const RunControl& control = {});

}  // namespace shelfbeam
