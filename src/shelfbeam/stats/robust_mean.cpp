#include "shelfbeam/stats/robust_mean.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "shelfbeam/stats/distributions.hpp"

namespace shelfbeam {

namespace {

constexpr double huber = 1.345;              // 95 % efficient for normal values
constexpr double half_of_a_normal = 0.6745;  // the median of |z|

double median_deviation(std::span<const double> distances, std::span<const double> errors, double spread) {
  std::vector<double> ratios(distances.size());
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    const double deviation = std::hypot(errors[i], spread);
    ratios[i] = distances[i] == 0 ? 0
                : deviation > 0   ? distances[i] / deviation
                                  : std::numeric_limits<double>::infinity();
  }
  std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2),
                   ratios.end());
  return ratios[ratios.size() / 2];
}

double unexplained_spread(std::span<const double> values, std::span<const double> errors, double median) {
  std::vector<double> distances;
  for (const double value : values) distances.push_back(std::abs(value - median));
  const auto n = static_cast<double>(values.size());
  // Corrects for the sample median being nearer to the values than the true one (Croux and Rousseeuw 1992).
  const double target = half_of_a_normal * (n - 0.8) / n;
  if (median_deviation(distances, errors, 0) <= target) return 0;
  double low = 0, high = 2 * *std::max_element(distances.begin(), distances.end());
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (median_deviation(distances, errors, middle) > target ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

RobustMean robust_mean(std::span<const double> values, std::span<const double> errors) {
  RobustMean mean;
  mean.value = quantile({values.begin(), values.end()}, 0.5);
  mean.spread = unexplained_spread(values, errors, mean.value);
  const std::size_t n = values.size();
  // Without any error or spread, all values are equal, and the common minimum does not matter.
  const double min_deviation = std::max(1e-9, 1e-9 * std::abs(mean.value));
  std::vector<double> plain(n);
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < n; ++i) {
    mean.deviations.push_back(std::max(std::hypot(errors[i], mean.spread), min_deviation));
    plain[i] = 1 / (mean.deviations[i] * mean.deviations[i]);
    sum += plain[i];
    squares += plain[i] * plain[i];
  }
  mean.effective_count = sum * sum / squares;
  mean.weights.resize(n);
  const double exact = 1e-12 * *std::min_element(mean.deviations.begin(), mean.deviations.end());
  for (int step = 0; step < 100; ++step) {
    double total = 0, moment = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double z = std::abs(values[i] - mean.value) / mean.deviations[i];
      mean.weights[i] = plain[i] * (z > huber ? huber / z : 1);
      total += mean.weights[i];
      moment += mean.weights[i] * (values[i] - mean.value);
    }
    mean.value += moment / total;
    if (std::abs(moment / total) <= exact) break;
  }
  double slope = 0;
  for (std::size_t i = 0; i < n; ++i)
    if (std::abs(values[i] - mean.value) <= huber * mean.deviations[i]) slope += plain[i];
  if (slope == 0) slope = sum;
  for (std::size_t i = 0; i < n; ++i) {
    const double z = (values[i] - mean.value) / mean.deviations[i];
    mean.influences.push_back(std::clamp(z, -huber, huber) / mean.deviations[i] / slope);
  }
  return mean;
}

GroupedError grouped_error(std::span<const double> influences, std::span<const std::uint32_t> groups) {
  std::map<std::uint32_t, double> sums;
  for (std::size_t i = 0; i < influences.size(); ++i) sums[groups[i]] += influences[i];
  double squares = 0;
  for (const auto& [group, sum] : sums) squares += sum * sum;
  const auto count = static_cast<double>(sums.size());
  return {
      sums.size() > 1 ? std::sqrt(squares * count / (count - 1)) : std::numeric_limits<double>::infinity(),
      sums.size()};
}

}  // namespace shelfbeam
