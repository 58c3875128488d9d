#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/stats/moments.hpp"
#include "shelfbeam/transport/run/simulation_options.hpp"

namespace shelfbeam {

/// A quantity that batches estimate, and what is known of it beside them.
struct FreshSum {
  double known = 0;        ///< the part in closed form
  SkewedMoments sampled;   ///< the rest, over batches
  std::uint32_t hits = 0;  ///< batches in which it was not 0

  double mean() const { return known + sampled.mean(); }
  /// One-sided limits, each on the wrong side of the truth with a chance of `level`: Student's, and further
  /// out where the batches are skewed to that side (Johnson 1978). Where the spread is not to be trusted
  /// (is_rare), the lower one is the part in closed form, as signals are not negative, and the upper one is
  /// for `rare_upper`.
  double lower(double level) const;
  double upper(double level) const;
  /// For quantities that were hit rarely: the chance of a hit is limited (success_limit), and its size by
  /// `largest`, the most that any batch gave any quantity of its kind, or `large_hit` requirements if that is
  /// more: nobody has seen the hit that was missed.
  double rare_upper(double level, double largest, double requirement) const;
  /// Whether the spread of the batches is not to be trusted: hit in fewer than `least_hits` of them, or so
  /// skewed that it rests on few.
  bool is_rare() const { return (hits < least_hits && hits < sampled.count()) || sampled.is_skewed(); }

  static constexpr std::uint32_t least_hits = 30;
  static constexpr double large_hit = 4;
};

/// Sums of signals over fresh batches, `width` for every label.
struct FreshSums {
  std::size_t width = 0;
  std::uint32_t batches = 0;
  std::uint64_t samples_per_batch = 0;
  std::vector<FreshSum> sums;  ///< of label i from i * width on
  double largest = 0;          ///< of all values of all sums in a batch, known light left out

  std::span<const FreshSum> of(std::size_t label) const {
    return std::span(sums).subspan(label * width, width);
  }
};

/// From the signals of all transceivers at a label, the sums that are wanted of it. Linear; called from
/// several threads.
using SumRule =
    std::function<void(std::size_t label, std::span<const double> signals, std::span<double> sums)>;

/// Simulates the scene anew. The same for any number of threads. Throws as `sample_batches`.
FreshSums fresh_sums(const Scene& scene, const SimulationOptions& options, std::uint32_t batches,
                     std::size_t width, const SumRule& rule, const RunControl& control);

}  // namespace shelfbeam
