#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "shelfbeam/signal/signal_matrix.hpp"

#include "programs.hpp"

namespace shelfbeam::bench {

/// Simulations of one store by one program with one set of options, one seed after the other.
class SeedRuns {
 public:
  void add(const Simulated& run);

  std::size_t seeds() const { return cpu_seconds_.size(); }
  std::size_t entries() const { return sums_.size(); }
  double mean(std::size_t entry) const { return sums_[entry] / static_cast<double>(seeds()); }
  /// The share of seeds in which the entry is flagged.
  double flagged(std::size_t entry) const { return flags_[entry] / static_cast<double>(seeds()); }

  /// The functions below omit the seed `omitted`; `none` omits no seed.
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  double cpu_seconds(std::size_t omitted) const;
  /// The mean over seeds of the squared standard error in the files.
  double claimed_variance(std::size_t entry, std::size_t omitted) const;
  /// The unbiased sample variance of the means.
  double variance_of_means(std::size_t entry, std::size_t omitted) const;
  /// The mean over seeds of (mean - truth)^2.
  double square_error(std::size_t entry, double truth, std::size_t omitted) const;
  /// The mean over seeds of (mean - a) (mean - b).
  double product_of_errors(std::size_t entry, double a, double b, std::size_t omitted) const;

 private:
  std::vector<double> cpu_seconds_, sums_, flags_;  ///< the last two are sums over seeds
  std::vector<std::vector<float>> means_, errors_;  ///< by seed
};

/// A number and its standard error.
struct Estimate {
  double value = 0, error = 0;
};

/// exp of a statistic over S seeds, which takes the seed to omit. The error is the jackknife's:
/// sqrt((S - 1) / S sum_s (t_s - mean of t)^2) for t_s without seed s, times exp.
Estimate ratio_over_seeds(std::size_t seeds, const std::function<double(std::size_t omitted)>& log_ratio);

/// The entries whose value is above a share of their label's requirement.
std::vector<std::size_t> entries_above(const std::vector<LabelRow>& labels, std::span<const double> values,
                                       double share);

}  // namespace shelfbeam::bench
