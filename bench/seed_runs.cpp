#include "seed_runs.hpp"

#include <cmath>
#include <stdexcept>

namespace shelfbeam::bench {

namespace {

// The mean of value(seed) over all seeds but `omitted`.
template <class Value>
double mean_over(std::size_t seeds, std::size_t omitted, const Value& value) {
  double sum = 0, count = 0;
  for (std::size_t s = 0; s < seeds; ++s) {
    if (s == omitted) continue;
    sum += value(s);
    ++count;
  }
  return sum / count;
}

double square(double x) {
  return x * x;
}

}  // namespace

void SeedRuns::add(const Simulated& run) {
  const SignalMatrix& matrix = run.matrix;
  if (sums_.empty()) sums_.assign(matrix.mean.size(), 0);
  flags_.resize(sums_.size());
  if (matrix.mean.size() != sums_.size()) throw std::runtime_error("matrices of different sizes");
  for (std::size_t e = 0; e < sums_.size(); ++e) {
    sums_[e] += static_cast<double>(matrix.mean[e]);
    flags_[e] += matrix.is_flagged(e) ? 1 : 0;
  }
  cpu_seconds_.push_back(run.cpu_seconds);
  means_.push_back(matrix.mean);
  errors_.push_back(matrix.standard_error);
}

double SeedRuns::cpu_seconds(std::size_t omitted) const {
  return mean_over(seeds(), omitted, [&](std::size_t s) { return cpu_seconds_[s]; });
}

double SeedRuns::claimed_variance(std::size_t entry, std::size_t omitted) const {
  return mean_over(seeds(), omitted,
                   [&](std::size_t s) { return square(static_cast<double>(errors_[s][entry])); });
}

double SeedRuns::variance_of_means(std::size_t entry, std::size_t omitted) const {
  const auto value = [&](std::size_t s) { return static_cast<double>(means_[s][entry]); };
  const double count = static_cast<double>(seeds() - (omitted == none ? 0 : 1));
  return square_error(entry, mean_over(seeds(), omitted, value), omitted) * count / (count - 1);
}

double SeedRuns::square_error(std::size_t entry, double truth, std::size_t omitted) const {
  return product_of_errors(entry, truth, truth, omitted);
}

double SeedRuns::product_of_errors(std::size_t entry, double a, double b, std::size_t omitted) const {
  return mean_over(seeds(), omitted, [&](std::size_t s) {
    const auto mean = static_cast<double>(means_[s][entry]);
    return (mean - a) * (mean - b);
  });
}

Estimate ratio_over_seeds(std::size_t seeds, const std::function<double(std::size_t)>& log_ratio) {
  std::vector<double> without;
  double sum = 0, squares = 0;
  for (std::size_t s = 0; s < seeds; ++s) {
    without.push_back(log_ratio(s));
    sum += without.back();
  }
  const auto count = static_cast<double>(seeds);
  for (const double value : without) squares += square(value - sum / count);
  const double ratio = std::exp(log_ratio(SeedRuns::none));
  return {ratio, ratio * std::sqrt(squares * (count - 1) / count)};
}

std::vector<std::size_t> entries_above(const std::vector<LabelRow>& labels, std::span<const double> values,
                                       double share) {
  const std::size_t width = values.size() / labels.size();
  std::vector<std::size_t> found;
  for (std::size_t e = 0; e < values.size(); ++e)
    if (values[e] > share * labels[e / width].requirement) found.push_back(e);
  return found;
}

}  // namespace shelfbeam::bench
