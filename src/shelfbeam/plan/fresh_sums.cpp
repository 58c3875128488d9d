#include "shelfbeam/plan/fresh_sums.hpp"

#include <algorithm>
#include <cmath>

#include "shelfbeam/stats/distributions.hpp"
#include "shelfbeam/transport/sample_batches.hpp"

namespace shelfbeam {

namespace {

double half_width(const Moments& sampled, double level) {
  const double error = sampled.standard_error();
  return error == 0 ? 0 : error * student_quantile(1 - level, static_cast<double>(sampled.count() - 1));
}

}  // namespace

double FreshSum::lower(double level) const {
  return mean() - half_width(sampled, level);
}

double FreshSum::upper(double level) const {
  return mean() + half_width(sampled, level);
}

double FreshSum::rare_upper(double level, double largest) const {
  return known + success_limit(hits, sampled.count(), level) * largest;
}

FreshSums fresh_sums(const Scene& scene, const SimulationOptions& options, std::uint32_t batches,
                     std::size_t width, const SumRule& rule, const RunControl& control) {
  const std::size_t rows = scene.labels.size();
  FreshSums result;
  result.width = width;
  result.batches = batches;
  result.sums.resize(rows * width);
  std::vector<double> largest(rows, 0);
  const auto take = [&](const BatchRow& row) {
    thread_local std::vector<double> values;
    values.assign(width, 0.0);
    rule(row.label, row.values, values);
    for (std::size_t k = 0; k < width; ++k) {
      FreshSum& sum = result.sums[row.label * width + k];
      sum.sampled.add(values[k]);
      if (values[k] != 0) ++sum.hits;
      largest[row.label] = std::max(largest[row.label], values[k]);
    }
  };
  const BatchRun run = sample_batches(scene, options, batches, take, control);
  result.samples_per_batch = run.samples_per_batch;
  result.rays = run.rays;
  result.largest = rows == 0 ? 0 : *std::max_element(largest.begin(), largest.end());
  const std::size_t columns = rows == 0 ? 0 : run.known.size() / rows;
  std::vector<double> signals(columns), values(width);
  for (std::size_t i = 0; i < rows; ++i) {
    std::copy_n(run.known.begin() + static_cast<std::ptrdiff_t>(i * columns), columns, signals.begin());
    std::fill(values.begin(), values.end(), 0.0);
    rule(i, signals, values);
    for (std::size_t k = 0; k < width; ++k) result.sums[i * width + k].known = values[k];
  }
  return result;
}

}  // namespace shelfbeam
