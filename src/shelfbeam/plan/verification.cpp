#include "shelfbeam/plan/verification.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "shelfbeam/math/order.hpp"
#include "shelfbeam/plan/validation_estimates.hpp"

namespace shelfbeam {

namespace {

double upper_limit(const ValidationEstimate& sum, double level, double largest, double requirement) {
  const double upper = sum.upper(level);
  return sum.is_rare() ? std::max(upper, sum.rare_upper(level, largest, requirement)) : upper;
}

// For each signal the sum of all others, without subtraction; exactly 0 if there are no others.
void sums_without_one(std::span<const double> signals, std::span<double> sums) {
  double before = 0, after = 0;
  for (std::size_t k = 0; k < signals.size(); ++k) {
    sums[k] = before;
    before += signals[k];
  }
  for (std::size_t k = signals.size(); k-- > 0;) {
    sums[k] += after;
    after += signals[k];
  }
}

void describe(LabelVerdict& label, const ValidationEstimate& sum) {
  label.signal = sum.mean();
  label.standard_error = sum.sampled.standard_error();
}

// Every sum must meet the requirement: that of all units, or all sums without one unit.
void judge_sums(LabelVerdict& label, std::span<const ValidationEstimate> sums, double largest, double level,
                double joint_level) {
  std::size_t weakest = 0;
  label.lower = label.joint_lower = label.upper = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < sums.size(); ++k) {
    if (sums[k].mean() < sums[weakest].mean()) weakest = k;
    label.lower = std::min(label.lower, sums[k].lower(level));
    label.joint_lower = std::min(label.joint_lower, sums[k].lower(joint_level));
    // Any of the upper limits may be too low by chance, so the sums share the level.
    label.upper = std::min(label.upper, upper_limit(sums[k], level / static_cast<double>(sums.size()),
                                                    largest, label.requirement));
  }
  describe(label, sums[weakest]);
}

// `needed` planned links, one or two, must meet the requirement.
void judge_links(LabelVerdict& label, std::span<const ValidationEstimate> sums, double largest,
                 std::span<const float> planned, std::size_t needed, double level, double joint_level) {
  if (sums.size() < needed) return;
  const std::vector<std::uint32_t> order =
      ordered_by(sums.size(), [&](std::uint32_t k) { return -planned[k]; });
  label.lower = label.joint_lower = std::numeric_limits<double>::infinity();
  std::size_t weakest = order[0];
  for (std::size_t k = 0; k < needed; ++k) {
    if (sums[order[k]].mean() < sums[weakest].mean()) weakest = order[k];
    label.lower = std::min(label.lower, sums[order[k]].lower(level));
    label.joint_lower = std::min(label.joint_lower, sums[order[k]].lower(joint_level));
  }
  describe(label, sums[weakest]);
  std::vector<double> upper(sums.size());
  for (std::size_t k = 0; k < sums.size(); ++k)
    upper[k] = upper_limit(sums[k], level / static_cast<double>(needed), largest, label.requirement);
  std::nth_element(upper.begin(), upper.begin() + static_cast<std::ptrdiff_t>(needed - 1), upper.end(),
                   std::greater<>());
  label.upper = upper[needed - 1];
}

}  // namespace

std::vector<LabelVerdict> verify(const PreparedScene& prepared, const BatchRequest& request,
                                 const PlacementProblem& problem, std::span<const float> planned,
                                 const VerdictLevels& levels, const RunControl& control) {
  const Scene& scene = prepared.world().scene;
  const std::size_t rows = request.labels.size(), columns = scene.transceivers.size();
  std::vector<LabelVerdict> labels(rows);
  for (std::size_t k = 0; k < rows; ++k)
    labels[k].requirement = scene.requirement_of(scene.labels[request.labels[k]]);
  if (rows == 0) return labels;
  if (columns == 0) {
    for (LabelVerdict& label : labels) label.verdict = Verdict::missed;
    return labels;
  }
  const bool adds_up = problem.model == CommunicationModel::cooperative;
  const std::size_t width = adds_up && !problem.redundant ? 1 : columns;
  const SumRule rule = [&](std::size_t, std::span<const double> signals, std::span<double> sums) {
    if (!adds_up)
      std::copy(signals.begin(), signals.end(), sums.begin());
    else if (problem.redundant)
      sums_without_one(signals, sums);
    else
      sums[0] = std::accumulate(signals.begin(), signals.end(), 0.0);
  };
  const ValidationEstimates fresh = validation_estimates(prepared, request, width, rule, control);
  // P(any of m verdicts is wrong) <= m (level / m), for any dependence between labels (Bonferroni); Sidak's 1
  // - (1 - level)^(1/m) requires independence and would be larger by a share of at most level / 2.
  const double of_one = levels.list / static_cast<double>(std::max(rows, levels.labels));
  for (std::size_t i = 0; i < rows; ++i) {
    LabelVerdict& label = labels[i];
    const std::span<const ValidationEstimate> sums = fresh.of(i);
    if (adds_up)
      judge_sums(label, sums, fresh.largest, of_one, levels.joint);
    else
      judge_links(label, sums, fresh.largest, planned.subspan(i * columns, columns),
                  problem.redundant ? 2 : 1, of_one, levels.joint);
    label.samples = fresh.batches * fresh.samples_per_batch;
    if (is_met(label.lower, label.requirement))
      label.verdict = Verdict::reached;
    else if (!is_met(label.upper, label.requirement))
      label.verdict = Verdict::missed;
  }
  return labels;
}

std::vector<LabelVerdict> verify(const Scene& scene, const PlacementProblem& problem,
                                 std::span<const float> planned, double level,
                                 const VerificationEffort& effort, const RunControl& control) {
  const auto prepared = prepare(scene, effort.simulation, false, control);
  const std::vector<LabelId> labels = all_numbers<LabelId>(scene.labels.size());
  return verify(*prepared, {labels, effort.simulation.seed, effort.batches}, problem, planned,
                {level, labels.size(), level}, control);
}

}  // namespace shelfbeam
