#include "shelfbeam/plan/refine.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "shelfbeam/plan/fresh_sums.hpp"
#include "shelfbeam/plan/sub_scene.hpp"

namespace shelfbeam {

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
  matrix.by_bounce.clear();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    LabelRow& label = matrix.labels[rows[k]];
    // Batches of both may differ in size, but errors tell what each is worth only where they are known well:
    // shares by samples do not depend on them.
    const auto old_samples = static_cast<double>(label.samples);
    const auto new_samples = static_cast<double>(fresh.batches * fresh.samples_per_batch);
    const double fresh_share = new_samples / (old_samples + new_samples);
    for (std::size_t j = 0; j < n; ++j) {
      const std::size_t at = matrix.at(rows[k], j);
      const FreshSum& sum = fresh.of(k)[j];
      const double old_error = (1 - fresh_share) * static_cast<double>(matrix.standard_error[at]);
      matrix.mean[at] = static_cast<float>((1 - fresh_share) * static_cast<double>(matrix.mean[at]) +
                                           fresh_share * sum.mean());
      matrix.standard_error[at] =
          static_cast<float>(std::hypot(old_error, fresh_share * sum.sampled.standard_error()));
    }
    label.batches += fresh.batches;
    label.samples += fresh.batches * fresh.samples_per_batch;
  }
}

}  // namespace shelfbeam
