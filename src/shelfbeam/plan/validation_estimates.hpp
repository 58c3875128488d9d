#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/stats/moments.hpp"
#include "shelfbeam/transport/run/sample_batches.hpp"

namespace shelfbeam {

/// A quantity estimated by batches, and its exact part.
struct ValidationEstimate {
  double known = 0;        ///< exact part, by closed form
  SkewedMoments sampled;   ///< sampled part, over batches
  std::uint32_t hits = 0;  ///< batches with a nonzero value

  double mean() const { return known + sampled.mean(); }
  /// One-sided limits, each wrong with probability `level`. With x the mean, s the standard error, g the
  /// skewness of the B batches and t = t_{B-1, 1-level} (Student; Johnson 1978):
  ///
  ///   upper = x + (t + max(0, g) (2 t^2 + 1) / (6 sqrt(B))) s
  ///   lower = x - (t + max(0, -g) (2 t^2 + 1) / (6 sqrt(B))) s
  ///
  /// If is_rare, the lower limit is the exact part, as signals are not negative, and the upper one is
  /// rare_upper.
  double lower(double level) const;
  double upper(double level) const;
  /// Upper limit for rarely hit quantities, known + p_h x_max: p_h limits the probability of a hit
  /// (success_probability_upper_limit), x_max is the larger of `largest`, the largest value that any batch
  /// gave any quantity of this kind, and `large_hit` requirements, because a missed hit has not been
  /// observed.
  double rare_upper(double level, double largest, double requirement) const;
  /// Whether the spread of the batches is unreliable: hit in fewer than `min_hits` of them, or so skewed that
  /// a few determine it.
  bool is_rare() const { return (hits < min_hits && hits < sampled.count()) || sampled.is_skewed(); }

  static constexpr std::uint32_t min_hits = 30;
  static constexpr double large_hit = 4;
};

/// Sums of signals over independent batches, `width` per label.
struct ValidationEstimates {
  std::size_t width = 0;
  std::uint32_t batches = 0;
  std::uint64_t samples_per_batch = 0;
  std::vector<ValidationEstimate> sums;  ///< those of label i start at i * width
  double largest = 0;  ///< largest sampled value of any sum in a batch, without analytic direct light

  std::span<const ValidationEstimate> of(std::size_t label) const {
    return std::span(sums).subspan(label * width, width);
  }
};

/// Computes the sums of a label from the signals of all transceivers. Linear; called from several threads.
using SumRule =
    std::function<void(std::size_t label, std::span<const double> signals, std::span<double> sums)>;

/// Samples some labels independently; `label` of the rule and of `of` is the position in the request. The
/// result is the same for any number of threads. Throws as `sample_batches`.
ValidationEstimates validation_estimates(const PreparedScene& prepared, const BatchRequest& request,
                                         std::size_t width, const SumRule& rule, const RunControl& control);

}  // namespace shelfbeam
