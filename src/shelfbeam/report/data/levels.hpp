#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace shelfbeam {

/// Labels of about the same height, drawn on one plan.
struct ShelfLevel {
  double low = 0, high = 0;           ///< m, heights of its lowest and highest label
  std::vector<std::uint32_t> labels;  ///< ascending

  /// "labels at 0.85 to 1.00 m"
  std::string heights() const;
};

/// The greatest difference in height within a level, m.
inline constexpr double level_band = 0.25;

/// Bands from the lowest label up: a label joins while it is at most level_band above the band's first.
std::vector<ShelfLevel> shelf_levels(std::span<const double> heights);

}  // namespace shelfbeam
