#include "shelfbeam/report/data/distributions.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "shelfbeam/report/data/scale.hpp"

namespace shelfbeam {

namespace {

void count(Bins& bins, double value) {
  const auto edge = std::upper_bound(bins.edges.begin(), bins.edges.end(), value);
  if (edge == bins.edges.begin())
    ++bins.below;
  else if (edge == bins.edges.end())
    ++bins.above;
  else
    ++bins.counts[static_cast<std::size_t>(edge - bins.edges.begin()) - 1];
}

}  // namespace

ExcessDistribution excess_distribution(const Outcome& outcome) {
  constexpr double target_bins = 24;
  std::vector<double> excess;
  for (const LabelOutcome& label : outcome.labels)
    if (label.requirement > 0) excess.push_back(100 * (label.signal - label.requirement) / label.requirement);
  if (excess.empty()) return {};

  ExcessDistribution result;
  result.median = quantile(excess, 0.5);
  result.mean = std::accumulate(excess.begin(), excess.end(), 0.0) / static_cast<double>(excess.size());
  const double smallest = *std::min_element(excess.begin(), excess.end());
  const double largest = quantile(excess, 0.99);
  const double low = std::min(0.0, smallest), high = std::max(largest, 1.0);
  const double width = round_step((high - low) / target_bins);
  // Whole multiples of the width, so that 0 (requirement just met) is an edge.
  const auto first = static_cast<int>(std::floor(low / width + 1e-9));
  const auto last = std::max(first + 1, static_cast<int>(std::floor(high / width)) + 1);
  for (int k = first; k <= last; ++k) result.percent.edges.push_back(k * width);
  result.percent.counts.assign(result.percent.edges.size() - 1, 0);
  for (const double value : excess) count(result.percent, value);
  return result;
}

SignalDistribution signal_distribution(const SignalMatrix& matrix) {
  SignalDistribution result;
  result.entries = matrix.mean.size();
  double smallest = 0, largest = 0;
  for (const float entry : matrix.mean) {
    const auto value = static_cast<double>(entry);
    if (value <= 0) {
      ++result.zeros;
      continue;
    }
    smallest = smallest == 0 ? value : std::min(smallest, value);
    largest = std::max(largest, value);
  }
  if (largest == 0) return result;
  const auto last = static_cast<int>(std::floor(std::log10(largest) * bins_per_decade)) + 1;
  const auto first = std::max(static_cast<int>(std::floor(std::log10(smallest) * bins_per_decade)),
                              last - signal_decades * bins_per_decade);
  for (int k = first; k <= last; ++k)
    result.signal.edges.push_back(std::pow(10, static_cast<double>(k) / bins_per_decade));
  result.signal.counts.assign(result.signal.edges.size() - 1, 0);
  for (const float entry : matrix.mean)
    if (entry > 0) count(result.signal, static_cast<double>(entry));
  return result;
}

SamplingSummary sampling_summary(const SignalMatrix& matrix) {
  SamplingSummary summary;
  summary.entries = matrix.mean.size();
  summary.has_errors = !matrix.mean.empty() && matrix.standard_error.size() == matrix.mean.size();
  summary.has_flags = !matrix.flags.empty();
  std::vector<double> relative;
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    const LabelRow& label = matrix.labels[i];
    for (std::size_t j = 0; j < matrix.columns(); ++j) {
      const auto mean = static_cast<double>(matrix.mean[matrix.at(i, j)]);
      if (mean <= 0) ++summary.zeros;
      if (mean <= 0 || mean < relevant_share * label.requirement) continue;
      ++summary.relevant;
      if (matrix.is_flagged(matrix.at(i, j))) ++summary.flagged;
      if (summary.has_errors)
        relative.push_back(static_cast<double>(matrix.standard_error[matrix.at(i, j)]) / mean);
    }
    const bool first = i == 0;
    summary.min_samples = first ? label.samples : std::min(summary.min_samples, label.samples);
    summary.max_samples = std::max(summary.max_samples, label.samples);
    summary.min_batches = first ? label.batches : std::min(summary.min_batches, label.batches);
    summary.max_batches = std::max(summary.max_batches, label.batches);
  }
  if (relative.empty()) return summary;
  std::sort(relative.begin(), relative.end());
  summary.mean =
      std::accumulate(relative.begin(), relative.end(), 0.0) / static_cast<double>(relative.size());
  summary.median = quantile(relative, 0.5);
  summary.p90 = quantile(relative, 0.9);
  summary.p99 = quantile(relative, 0.99);
  summary.worst = relative.back();
  return summary;
}

std::size_t uncertain_labels(const SignalMatrix& matrix, const Outcome& outcome) {
  if (matrix.standard_error.size() != matrix.mean.size()) return 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < outcome.labels.size(); ++i) {
    const LabelOutcome& label = outcome.labels[i];
    if (!label.strongest) continue;
    const auto error = static_cast<double>(matrix.standard_error[matrix.at(i, *label.strongest)]);
    if (std::abs(label.signal - label.requirement) < 2 * error) ++count;
  }
  return count;
}

}  // namespace shelfbeam
