#include "shelfbeam/plan/validation_estimates.hpp"

#include <algorithm>
#include <cmath>

#include "shelfbeam/stats/distributions.hpp"

namespace shelfbeam {

namespace {

// `tail`: the skewness towards the side of the limit. Student's t of skewed values is itself skewed, the
// other way: to first order in B^-1/2 its quantile moves by skewness (2 t^2 + 1) / (6 B^1/2) (Johnson 1978).
// A correction that would narrow the interval is not applied.
double half_width(const SkewedMoments& sampled, double tail, double level) {
  const double error = sampled.standard_error();
  if (error == 0) return 0;
  const auto batches = static_cast<double>(sampled.count());
  const double t = -student_quantile(level, batches - 1);
  return error * (t + std::max(0.0, tail) * (2 * t * t + 1) / (6 * std::sqrt(batches)));
}

}  // namespace

double ValidationEstimate::lower(double level) const {
  if (is_rare()) return known;
  return mean() - half_width(sampled, -sampled.skewness(), level);
}

double ValidationEstimate::upper(double level) const {
  return mean() + half_width(sampled, sampled.skewness(), level);
}

double ValidationEstimate::rare_upper(double level, double largest, double requirement) const {
  return known + success_probability_upper_limit(hits, sampled.count(), level) *
                     std::max(largest, large_hit * requirement);
}

ValidationEstimates validation_estimates(const PreparedScene& prepared, const BatchRequest& request,
                                         std::size_t width, const SumRule& rule, const RunControl& control) {
  const std::size_t rows = request.labels.size();
  ValidationEstimates result;
  result.width = width;
  result.batches = request.batches;
  result.sums.resize(rows * width);
  std::vector<double> largest(rows, 0);
  const auto take = [&](const BatchRow& row) {
    thread_local std::vector<double> values;
    values.assign(width, 0.0);
    rule(row.label, row.values, values);
    for (std::size_t k = 0; k < width; ++k) {
      ValidationEstimate& sum = result.sums[row.label * width + k];
      sum.sampled.add(values[k]);
      if (values[k] != 0) ++sum.hits;
      largest[row.label] = std::max(largest[row.label], values[k]);
    }
  };
  const BatchRun run = sample_batches(prepared, request, take, control);
  result.samples_per_batch = run.samples_per_batch;
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
