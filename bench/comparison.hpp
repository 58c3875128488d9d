#pragma once

#include <cstddef>
#include <vector>

#include "shelfbeam/scene/scene.hpp"

#include "entrants.hpp"

namespace shelfbeam::bench {

/// 1 / (variance x CPU time) of one estimator over that of another: geometric mean over the entries whose
/// mean by the first estimator is above a share of their label's requirement.
struct EfficiencyRatio {
  double ratio = 0, without_cache = 0;
  std::size_t entries = 0;
  std::size_t omitted = 0;  ///< entries with too few contributions in one estimator, or without spread
};

EfficiencyRatio efficiency_ratio(const Scene& scene, const Selection& selection, const Entrant& one,
                                 const Entrant& other, double above, std::uint32_t min_contributions);

/// Differences d of two sets of means over their standard errors s.
///
/// Many entries of the uniform estimator rest on a few large contributions. If it misses these, its mean and
/// its standard error are both too small, and d / s is large with one sign. This does not affect `pooled` =
/// sqrt(sum (d / first mean)^2 / sum (s / first mean)^2), because s^2 is unbiased.
struct Agreement {
  std::size_t values = 0;
  double pooled = 0;
  double rms = 0, largest = 0, beyond_3 = 0;  ///< of |d / s|; beyond_3 is the share above 3
};

Agreement agreement(const std::vector<BatchMean>& one, const std::vector<BatchMean>& other);
/// The agreement of all entries with enough contributions.
Agreement agreement(const BatchSums& one, const BatchSums& other, std::uint32_t min_contributions);

}  // namespace shelfbeam::bench
