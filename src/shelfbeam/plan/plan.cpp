#include "shelfbeam/plan/plan.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/placement/coverage/coverage_curve.hpp"
#include "shelfbeam/plan/alternatives/alternatives.hpp"
#include "shelfbeam/plan/question/fitting_signals.hpp"
#include "shelfbeam/plan/question/question_key.hpp"
#include "shelfbeam/plan/rounds.hpp"
#include "shelfbeam/plan/sensitivity.hpp"
#include "shelfbeam/plan/sub_scene.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"
#include "shelfbeam/transport/run/prepared_scene.hpp"

namespace shelfbeam {

namespace {

constexpr double share_of_first_placement = 0.25;

// nullopt if interrupted: earlier results stay.
std::optional<Sensitivity> sensitivity_of(const Scene& scene, const Plan& plan,
                                          const SensitivityOptions& options, const SimulationOptions& fresh,
                                          const RunControl& control) {
  const SignalMatrix& matrix = plan.simulation.matrix;
  const std::vector<LabelId> labels = all_numbers<LabelId>(matrix.rows());
  std::vector<float> planned;
  for (const LabelId i : labels)
    for (const std::uint32_t j : plan.placement.selected) planned.push_back(matrix.mean[matrix.at(i, j)]);
  VerificationEffort effort{fresh, min_verifying_batches};
  effort.simulation.samples = std::max(fresh.samples, Rounds::min_samples * batch_count);
  effort.simulation.relative_error.reset();
  effort.simulation.time_s.reset();
  effort.simulation.seed = mix_key(fresh.seed ^ 0x73656e7369746976, 0);
  try {
    return reflectance_sensitivity(sub_scene(scene, labels, plan.placement.selected), plan.placement.problem,
                                   planned, options, effort, control);
  } catch (const Interrupted&) {
    return std::nullopt;
  }
}

// A warning if the margins of nearly all labels show that a requirement or a flux is wrong.
std::optional<Finding> margin_warning(const SignalTable& table, const Placement& placement) {
  constexpr double nearly_all = 0.9, far_too_much = 31.6;  // 15 dB
  const double share = 100.0 / static_cast<double>(std::max<std::size_t>(1, table.rows()));
  const double out_of_reach = share * static_cast<double>(placement.unreachable.size());
  if (out_of_reach >= 100 * nearly_all)
    return Finding{
        FindingCode::labels_out_of_reach,
        "label_types",
        {out_of_reach},
        fmt::format("label_types: no selection reaches {:.0f} % of the labels; a few are typical; check "
                    "thresholds, safety factors and the emission of the transceivers",
                    out_of_reach)};
  const std::vector<bool> chosen = marked(table.columns(), placement.selected);
  std::size_t flooded = 0;
  for (std::size_t i = 0; i < table.rows(); ++i)
    if (received_signal(table.row(i), chosen, placement.problem) >
        far_too_much * requirement_of(table.labels[i], placement.problem.model))
      ++flooded;
  const double flooded_share = share * static_cast<double>(flooded);
  if (flooded_share < 100 * nearly_all) return {};
  return Finding{FindingCode::labels_flooded,
                 "label_types",
                 {flooded_share},
                 fmt::format("label_types: {:.0f} % of the labels receive more than 30 times the signal that "
                             "they require (15 dB); 1 to 10 times is typical; check thresholds, safety "
                             "factors and the emission of the transceivers",
                             flooded_share)};
}

SimulationResult result_of(SignalMatrix matrix) {
  const auto [least, most] =
      std::minmax_element(matrix.labels.begin(), matrix.labels.end(),
                          [](const LabelRow& a, const LabelRow& b) { return a.samples < b.samples; });
  SimulationResult result;
  result.summary.complete = true;
  result.summary.labels = matrix.rows();
  result.summary.candidates = matrix.columns();
  result.summary.min_samples = least->samples;
  result.summary.max_samples = most->samples;
  result.matrix = std::move(matrix);
  return result;
}

// The given signals, if they fit.
std::optional<SimulationResult> reused(std::optional<StoredSignals> signals, const Scene& scene,
                                       const PathRules& wanted, std::optional<GivenSignals>& given) {
  if (!signals) return {};
  const ReusedSignals all{signals->rows(), signals->columns(), signals->provenance.seed};
  auto fitting = fitting_signals(std::move(*signals), scene, wanted);
  if (auto* reason = std::get_if<MisfitReason>(&fitting)) {
    given = std::move(*reason);
    return {};
  }
  given = all;
  return result_of(std::get<SignalMatrix>(std::move(fitting)));
}

// The selection stays, whatever its labels receive.
void verify_selection(const Scene& scene, SimulationOptions fresh, const PlanOptions& options,
                      const RunControl& control, Plan& plan) {
  fresh.seed = options.simulation.seed;  // verify_installation forms the key of its question
  plan.certificate = verify_installation(with_units(scene, plan.placement.selected), plan.placement.problem,
                                         {*options.confidence, options.budget, fresh, options.place}, control)
                         .certificate;
}

// May refine the matrix and change the placement. `prepared`: null unless rows of signals can be sampled.
void certify_placement(const Scene& scene, const PreparedScene* prepared, const TableRule& table,
                       const SimulationOptions& fresh, const PlanOptions& options, const RunControl& control,
                       Plan& plan) {
  const CertifyOptions how{*options.confidence, options.budget, fresh, options.place};
  SignalMatrix matrix = std::move(plan.simulation.matrix);
  Certified certified =
      prepared != nullptr
          ? certify(*prepared, table, how, std::move(matrix), std::move(plan.placement), control)
          : certify(scene, table, how, std::move(matrix), std::move(plan.placement), control);
  plan.simulation.matrix = std::move(certified.matrix);
  plan.placement = std::move(certified.placement);
  plan.certificate = std::move(certified.certificate);
  plan.certificate->mark_unverified();
}

}  // namespace

Plan make_plan(const Scene& scene, PlanOptions options, const RunControl& control) {
  Plan plan;
  plan.seed = options.simulation.seed;
  // Rows of signals are sampled again for the certificate.
  const bool has_rows = options.simulation.strategy != Strategy::particle;
  const bool is_partial = options.partial.is_asked();
  auto known = reused(std::move(options.signals), scene, options.simulation.rules(), plan.signals);
  std::unique_ptr<const PreparedScene> prepared;
  if (!known || (options.confidence && has_rows && !is_partial))
    prepared = prepare(scene, options.simulation, true, control);
  plan.simulation = known ? std::move(*known) : simulate(*prepared, options.simulation, control);
  const TableRule table =
      options.table ? options.table : [](const SignalMatrix& matrix) { return make_signal_table(matrix); };
  // A certificate may place again, on signals that are more accurate where they decide.
  PlaceOptions first = options.place;
  if (options.confidence && !is_partial) first.time_limit_s *= share_of_first_placement;
  // Independent samples of few units are traced from the labels.
  SimulationOptions fresh = options.simulation;
  if (!has_rows) fresh.strategy = Strategy::mis;
  {
    const SignalTable first_table = table(plan.simulation.matrix);
    plan.placement = is_partial
                         ? place_partially(first_table, options.problem, options.partial, first, control)
                         : place(first_table, options.problem, first, control);
    if (options.confidence || options.sensitivity)
      fresh.seed = question_key(options.simulation.seed, first_table, options.problem);
  }
  const bool says_something = is_partial
                                  ? !plan.placement.selected.empty()
                                  : plan.placement.has_selection() || !plan.placement.unreachable.empty();
  if (options.confidence && plan.simulation.summary.complete && says_something) {
    if (is_partial)
      verify_selection(scene, fresh, options, control, plan);
    else
      certify_placement(scene, has_rows ? prepared.get() : nullptr, table, fresh, options, control, plan);
  }
  const SignalTable last = table(plan.simulation.matrix);
  if (options.curve && !is_partial && plan.placement.has_selection())
    plan.curve =
        add_curve(plan.placement, last, options.place.time_limit_s, control, plan.certificate.has_value());
  if (options.alternatives && !is_partial && plan.simulation.summary.complete)
    plan.alternatives = alternatives_to(plan.placement, last, control);
  if (options.sensitivity && plan.simulation.summary.complete && plan.placement.has_selection())
    plan.sensitivity = sensitivity_of(scene, plan, *options.sensitivity, fresh, control);
  plan.values = scene.values;
  plan.is_example = scene.source == ValueSource::example;
  plan.warnings = scene.warnings;
  if (auto warning = margin_warning(last, plan.placement)) plan.warnings.push_back(*std::move(warning));
  plan.complete = plan.simulation.summary.complete && !control.cancelled();
  return plan;
}

}  // namespace shelfbeam
