#include "shelfbeam/plan/refine.hpp"

#include <algorithm>
#include <cmath>

#include "shelfbeam/math/order.hpp"

namespace shelfbeam {

void join(const ValidationRow& fresh, SignalMatrix& matrix) {
  LabelRow& row = matrix.labels[fresh.label];
  // Weights by samples do not depend on errors, which are less certain than the means.
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
      // A part with an unreliable error flags the joint entry if it has half of the samples or most of the
      // spread.
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

ValidationRow validation_row(const ValidationEstimates& fresh, std::size_t k, LabelId label,
                             std::span<const std::uint32_t> order) {
  const std::size_t n = order.size();
  ValidationRow row{label,
                    std::vector<double>(n),
                    std::vector<double>(n),
                    std::vector<std::uint8_t>(n),
                    fresh.batches,
                    fresh.batches * fresh.samples_per_batch};
  for (std::size_t c = 0; c < n; ++c) {
    const ValidationEstimate& sum = fresh.of(k)[c];
    row.mean[order[c]] = sum.mean();
    row.standard_error[order[c]] = sum.sampled.standard_error();
    row.flags[order[c]] = sum.sampled.is_skewed() ? 1 : 0;
  }
  return row;
}

std::vector<ValidationRow> validation_rows(const PreparedScene& prepared, const BatchRequest& request,
                                           const RunControl& control) {
  const SumRule each = [](std::size_t, std::span<const double> signals, std::span<double> sums) {
    std::copy(signals.begin(), signals.end(), sums.begin());
  };
  const std::size_t columns = prepared.world().emitters.size();
  const ValidationEstimates fresh = validation_estimates(prepared, request, columns, each, control);
  const std::vector<std::uint32_t> in_order = all_numbers(columns);
  std::vector<ValidationRow> rows;
  for (std::size_t k = 0; k < request.labels.size(); ++k)
    rows.push_back(validation_row(fresh, k, request.labels[k], in_order));
  return rows;
}

}  // namespace shelfbeam
