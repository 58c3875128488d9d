#include "shelfbeam/report/data/sampling.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace shelfbeam {

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
      if (mean == 0) ++summary.zeros;
      if (mean <= 0 || mean < relevant_share * label.requirement) continue;
      ++summary.relevant;
      if (matrix.is_flagged(matrix.at(i, j))) ++summary.flagged;
      if (summary.has_errors)
        relative.push_back(static_cast<double>(matrix.standard_error[matrix.at(i, j)]) / mean);
    }
    const bool first = i == 0;
    summary.least_samples = first ? label.samples : std::min(summary.least_samples, label.samples);
    summary.most_samples = std::max(summary.most_samples, label.samples);
    summary.least_batches = first ? label.batches : std::min(summary.least_batches, label.batches);
    summary.most_batches = std::max(summary.most_batches, label.batches);
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
