#pragma once

#include <cstddef>
#include <cstdint>

#include "shelfbeam/transport/cache/profile_irradiance.hpp"

namespace shelfbeam {

/// The inner loops of the light operator, compiled for several instruction sets.
struct OperatorKernels {
  struct Points {
    const float *x, *y, *z, *nx, *ny, *nz;
  };
  struct Unit {
    LaneProfile profile;  ///< other than table
    LaneVector position, axis;
    float scale;
  };
  /// Writes profile_irradiance at `count` points.
  static void irradiance(const Unit& unit, const Points& points, std::size_t count, float* result);

  /// Rows of weights as in LabelRows.
  struct Rows {
    const std::uint8_t* masks;
    const std::uint32_t* first;
    const std::uint16_t* weights;
  };
  static constexpr std::size_t group = 16, max_groups = 6;
  /// LabelRows::add_to.
  static void add_rows(const Rows& all, const std::uint32_t* rows, const float* values, std::size_t count,
                       float* sums);
  static void add_rows(const Rows& all, const std::uint32_t* rows, const float* values,
                       const float* deviations, std::size_t count, float* sums, float* squares);
};

}  // namespace shelfbeam
