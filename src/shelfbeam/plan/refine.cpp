#include "shelfbeam/plan/refine.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "shelfbeam/plan/fresh_sums.hpp"
#include "shelfbeam/plan/sub_scene.hpp"

namespace shelfbeam {

void join(const FreshRow& fresh, SignalMatrix& matrix) {
  LabelRow& row = matrix.labels[fresh.label];
  // Shares by samples do not depend on errors, which are known less well than the means.
  const auto old_samples = static_cast<double>(row.samples), new_samples = static_cast<double>(fresh.samples);
  const double share = new_samples / (old_samples + new_samples);
  for (std::size_t j = 0; j < matrix.columns(); ++j) {
    const std::size_t at = matrix.at(fresh.label, j);
    const auto old_mean = static_cast<double>(matrix.mean[at]);
    const auto old_error = static_cast<double>(matrix.standard_error[at]);
    matrix.mean[at] = static_cast<float>((1 - share) * old_mean + share * fresh.mean[j]);
    matrix.standard_error[at] =
        static_cast<float>(std::hypot((1 - share) * old_error, share * fresh.standard_error[j]));
    if (!matrix.flags.empty()) {
      // A part with an error that cannot be trusted decides the joint one if it has half of the samples or
      // most of the spread.
      const double old_part = (1 - share) * old_error, new_part = share * fresh.standard_error[j];
      const bool keeps = matrix.flags[at] != 0 && (share <= 0.5 || old_part >= new_part);
      const bool gets = fresh.flags[j] != 0 && (share >= 0.5 || new_part >= old_part);
      matrix.flags[at] = keeps || gets ? 1 : 0;
    }
  }
  row.batches += fresh.batches;
  row.samples += fresh.samples;
  matrix.by_bounce.clear();
  matrix.by_length.clear();
}

std::vector<FreshRow> fresh_rows(const Scene& scene, const std::vector<std::uint32_t>& labels,
                                 const VerificationEffort& effort, const RunControl& control) {
  std::vector<std::uint32_t> all(scene.transceivers.size());
  std::iota(all.begin(), all.end(), 0U);
  SimulationOptions options = effort.simulation;
  options.seed = effort.seed;
  const SumRule each = [](std::size_t, std::span<const double> signals, std::span<double> sums) {
    std::copy(signals.begin(), signals.end(), sums.begin());
  };
  const FreshSums fresh =
      fresh_sums(sub_scene(scene, labels, all), options, effort.batches, all.size(), each, control);
  std::vector<FreshRow> rows;
  for (std::size_t k = 0; k < labels.size(); ++k) {
    rows.push_back({labels[k], {}, {}, {}, fresh.batches, fresh.batches * fresh.samples_per_batch});
    for (const FreshSum& sum : fresh.of(k)) {
      rows.back().mean.push_back(sum.mean());
      rows.back().standard_error.push_back(sum.sampled.standard_error());
      rows.back().flags.push_back(sum.is_skewed() ? 1 : 0);
    }
  }
  return rows;
}

RowsBefore::RowsBefore(SignalMatrix& matrix, std::vector<std::uint32_t> labels)
    : labels_(std::move(labels)),
      by_bounce_(std::move(matrix.by_bounce)),
      by_length_(std::move(matrix.by_length)) {
  matrix.by_bounce.clear();
  matrix.by_length.clear();
  const std::size_t n = matrix.columns();
  for (const std::uint32_t i : labels_) {
    rows_.push_back(matrix.labels[i]);
    const auto first = static_cast<std::ptrdiff_t>(matrix.at(i, 0)),
               last = first + static_cast<std::ptrdiff_t>(n);
    mean_.insert(mean_.end(), matrix.mean.begin() + first, matrix.mean.begin() + last);
    standard_error_.insert(standard_error_.end(), matrix.standard_error.begin() + first,
                           matrix.standard_error.begin() + last);
    if (!matrix.flags.empty())
      flags_.insert(flags_.end(), matrix.flags.begin() + first, matrix.flags.begin() + last);
  }
}

void RowsBefore::restore(SignalMatrix& matrix) {
  const std::size_t n = matrix.columns();
  for (std::size_t k = 0; k < labels_.size(); ++k) {
    matrix.labels[labels_[k]] = rows_[k];
    const auto to = static_cast<std::ptrdiff_t>(matrix.at(labels_[k], 0));
    const auto from = static_cast<std::ptrdiff_t>(k * n);
    std::copy_n(mean_.begin() + from, n, matrix.mean.begin() + to);
    std::copy_n(standard_error_.begin() + from, n, matrix.standard_error.begin() + to);
    if (!flags_.empty()) std::copy_n(flags_.begin() + from, n, matrix.flags.begin() + to);
  }
  matrix.by_bounce = std::move(by_bounce_);
  matrix.by_length = std::move(by_length_);
}

}  // namespace shelfbeam
