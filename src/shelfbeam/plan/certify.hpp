#pragma once

#include <functional>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/plan/answer/certificate.hpp"
#include "shelfbeam/plan/answer/certified_plan.hpp"
#include "shelfbeam/plan/answer/round_budget.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"
#include "shelfbeam/transport/run/simulation_options.hpp"

namespace shelfbeam {

class PreparedScene;

struct CertifyOptions {
  double confidence = 0.99;
  RoundBudget budget = {};  ///< for everything after the first placement
  /// Estimator, memory limit and seed. `certify` keys its samples by this seed, which should be that of the
  /// question (question_key); `verify_installation` forms the key of its question itself.
  SimulationOptions simulation = {};
  PlaceOptions place = {};
};

/// Makes the table for the placement: the matrix with its constraints.
using TableRule = std::function<SignalTable(const SignalMatrix&)>;

/// The result of certifying a placement. `placement` is made on `matrix`, and the verdicts of `certificate`
/// refer to its selection.
struct Certified {
  SignalMatrix matrix;  ///< updated with independent samples where the placement was undecided
  Placement placement;
  Certificate certificate;
};

/// Carries sampling errors through to the decision (docs/methods/certified_plan.md). If the search for the
/// placement stopped with a gap, labels that may decide on a cheaper selection are sampled first, and the
/// problem is solved again. Rounds r = 1, 2, ... have their own random numbers and the level
/// a_r = (1 - confidence) / 2^r. Each round
/// - simulates the selected units with independent samples and calls every label reached, missed or undecided
///   (verification.hpp, rounds.hpp),
/// - tests that no cheaper selection reaches all labels (bound_rounds.hpp),
/// - updates the matrix with more samples, for all candidates, of the labels that seem to be missed, and
///   solves the placement problem again if that may change the selection.
///
/// If the matrix leaves labels unreachable, their upper confidence limits must do so, too; every selection
/// then misses them.
///
/// Certification ends when both statements hold, when the budget is used up or can decide nothing more, or
/// when cancelled. If the last selection has undecided labels, or costs more than an earlier one that
/// reaches all labels, the result is the earlier one. An interrupted round leaves matrix and placement
/// unchanged. Pass the matrix by move to avoid a copy. With a budget in samples and a step limit for
/// placements, the result does not depend on the machine, unless the search for a refutation takes longer
/// than a minute.
///
/// The bound is on the count, or on the cost where prices alone determine it (has_known_prices). Other
/// objectives are those of the matrix. Throws as `sample_batches`, except on an interruption.
Certified certify(const PreparedScene& prepared, const TableRule& table, const CertifyOptions& options,
                  SignalMatrix matrix, Placement placement, const RunControl& control = {});

/// Prepares the scene first.
Certified certify(const Scene& scene, const TableRule& table, const CertifyOptions& options,
                  SignalMatrix matrix, Placement placement, const RunControl& control = {});

/// Verifies mounted units, all transceivers of the scene, in such rounds, until every label is reached or
/// missed. The certificate has no lower bound. Non-cooperative: a simulation with `options` plans the link of
/// each label. Throws as `simulate`.
CertifiedPlan verify_installation(const Scene& scene, const PlacementProblem& problem,
                                  const CertifyOptions& options, const RunControl& control = {});

}  // namespace shelfbeam
