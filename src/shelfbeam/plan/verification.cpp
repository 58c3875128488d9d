#include "shelfbeam/plan/verification.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "shelfbeam/plan/fresh_sums.hpp"

namespace shelfbeam {

namespace {

double upper_limit(const FreshSum& sum, double level, double largest, double requirement) {
  const double upper = sum.upper(level);
  return sum.is_rare() ? std::max(upper, sum.rare_upper(level, largest, requirement)) : upper;
}

// The sum of all signals but one, for each, without subtraction: where nothing is left it is 0.
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

void describe(LabelVerdict& label, const FreshSum& sum) {
  label.signal = sum.mean();
  label.standard_error = sum.sampled.standard_error();
}

// Every sum must meet the requirement: that of all units, or those without one of them.
void judge_sums(LabelVerdict& label, std::span<const FreshSum> sums, double largest, double level) {
  std::size_t weakest = 0;
  label.lower = label.upper = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < sums.size(); ++k) {
    if (sums[k].mean() < sums[weakest].mean()) weakest = k;
    label.lower = std::min(label.lower, sums[k].lower(level));
    // Any of them may be the one that fails by chance.
    label.upper = std::min(label.upper, upper_limit(sums[k], level / static_cast<double>(sums.size()),
                                                    largest, label.requirement));
  }
  describe(label, sums[weakest]);
}

// So many links must do, one or two, and which they are was planned.
void judge_links(LabelVerdict& label, std::span<const FreshSum> sums, double largest,
                 std::span<const float> planned, std::size_t needed, double level) {
  if (sums.size() < needed) return;
  std::vector<std::size_t> order(sums.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return planned[a] > planned[b]; });
  label.lower = std::numeric_limits<double>::infinity();
  std::size_t weakest = order[0];
  for (std::size_t k = 0; k < needed; ++k) {
    if (sums[order[k]].mean() < sums[weakest].mean()) weakest = order[k];
    label.lower = std::min(label.lower, sums[order[k]].lower(level));
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

std::vector<LabelVerdict> verify(const Scene& scene, const Question& question, std::span<const float> planned,
                                 double level, const VerificationEffort& effort, const RunControl& control) {
  const std::size_t rows = scene.labels.size(), columns = scene.transceivers.size();
  std::vector<LabelVerdict> labels(rows);
  for (std::size_t i = 0; i < rows; ++i) labels[i].requirement = scene.type_of(scene.labels[i]).requirement();
  if (rows == 0) return labels;
  if (columns == 0) {
    for (LabelVerdict& label : labels) label.verdict = Verdict::missed;
    return labels;
  }
  const bool adds_up = question.model == CommunicationModel::cooperative;
  const std::size_t width = adds_up && !question.redundant ? 1 : columns;
  const SumRule rule = [&](std::size_t, std::span<const double> signals, std::span<double> sums) {
    if (!adds_up)
      std::copy(signals.begin(), signals.end(), sums.begin());
    else if (question.redundant)
      sums_without_one(signals, sums);
    else
      sums[0] = std::accumulate(signals.begin(), signals.end(), 0.0);
  };
  const FreshSums fresh = fresh_sums(scene, effort.simulation, effort.batches, width, rule, control);
  // P(any of m verdicts is wrong) <= m (level / m), whatever the dependence between labels (Bonferroni);
  // Sidak's 1 - (1 - level)^(1/m) asks for independence and would be larger by a share of level / 2 at most.
  const double of_one = level / static_cast<double>(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    LabelVerdict& label = labels[i];
    const std::span<const FreshSum> sums = fresh.of(i);
    if (adds_up)
      judge_sums(label, sums, fresh.largest, of_one);
    else
      judge_links(label, sums, fresh.largest, planned.subspan(i * columns, columns),
                  question.redundant ? 2 : 1, of_one);
    label.samples = fresh.batches * fresh.samples_per_batch;
    if (is_met(label.lower, label.requirement))
      label.verdict = Verdict::reached;
    else if (!is_met(label.upper, label.requirement))
      label.verdict = Verdict::missed;
  }
  return labels;
}

}  // namespace shelfbeam
