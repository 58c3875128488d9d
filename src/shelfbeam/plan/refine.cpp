#include "shelfbeam/plan/refine.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "shelfbeam/plan/fresh_sums.hpp"
#include "shelfbeam/plan/sub_scene.hpp"

namespace shelfbeam {

void join(const FreshRow& fresh, std::size_t label, SignalMatrix& matrix) {
  LabelRow& row = matrix.labels[label];
  // Shares by samples do not depend on errors, which are known less well than the means.
  const auto old_samples = static_cast<double>(row.samples), new_samples = static_cast<double>(fresh.samples);
  const double share = new_samples / (old_samples + new_samples);
  for (std::size_t j = 0; j < matrix.columns(); ++j) {
    const std::size_t at = matrix.at(label, j);
    const auto old_mean = static_cast<double>(matrix.mean[at]);
    const auto old_error = static_cast<double>(matrix.standard_error[at]);
    matrix.mean[at] = static_cast<float>((1 - share) * old_mean + share * fresh.mean[j]);
    matrix.standard_error[at] =
        static_cast<float>(std::hypot((1 - share) * old_error, share * fresh.standard_error[j]));
  }
  row.batches += fresh.batches;
  row.samples += fresh.samples;
  matrix.by_bounce.clear();
  matrix.by_length.clear();
}

void refine(const Scene& scene, const std::vector<std::uint32_t>& rows, const VerificationEffort& effort,
            SignalMatrix& matrix, const RunControl& control) {
  const std::size_t n = matrix.columns();
  std::vector<std::uint32_t> all(n);
  std::iota(all.begin(), all.end(), 0U);
  SimulationOptions options = effort.simulation;
  options.seed = effort.seed;
  const SumRule each = [](std::size_t, std::span<const double> signals, std::span<double> sums) {
    std::copy(signals.begin(), signals.end(), sums.begin());
  };
  const FreshSums fresh = fresh_sums(sub_scene(scene, rows, all), options, effort.batches, n, each, control);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    FreshRow row{{}, {}, fresh.batches, fresh.batches * fresh.samples_per_batch};
    for (const FreshSum& sum : fresh.of(k)) {
      row.mean.push_back(sum.mean());
      row.standard_error.push_back(sum.sampled.standard_error());
    }
    join(row, rows[k], matrix);
  }
}

}  // namespace shelfbeam
