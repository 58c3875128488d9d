#pragma once

#include <cstddef>
#include <vector>

#include "shelfbeam/scene/scene.hpp"

#include "entrants.hpp"

namespace shelfbeam::bench {

/// 1 / (variance x CPU time) of an estimator over that of another: geometric mean over the entries above a
/// share of their label's requirement. Which these are goes by the first one's means.
struct EfficiencyRatio {
  double ratio = 0, without_cache = 0;
  std::size_t entries = 0;
  std::size_t left_out = 0;  ///< too few contributions in one of them, or no spread
};

EfficiencyRatio efficiency_ratio(const Scene& scene, const Selection& selection, const Entrant& one,
                                 const Entrant& other, double above, std::uint32_t least_contributions);

/// Differences d of two sets of means over their standard errors s.
///
/// Of the uniform estimator's entries many rest on a few large contributions: where it missed these, its mean
/// and its standard error are both too small, and d / s large with one sign. `pooled` does not mind, as s^2
/// is right on average: sqrt(sum (d / first mean)^2 / sum (s / first mean)^2).
struct Agreement {
  std::size_t values = 0;
  double pooled = 0;
  double rms = 0, largest = 0, beyond_3 = 0;  ///< of d / s; the last a share
};

Agreement agreement(const std::vector<BatchMean>& one, const std::vector<BatchMean>& other);
/// Of the entries that have enough contributions.
Agreement agreement(const BatchSums& one, const BatchSums& other, std::uint32_t least_contributions);

}  // namespace shelfbeam::bench
