#pragma once

#include <cstddef>
#include <cstdint>

#include "shelfbeam/transport/unit_groups.hpp"

namespace shelfbeam {

/// The inner loops over lanes, compiled for several kinds of processor.
struct LaneKernels {
  /// UnitGroups::irradiance.
  static void irradiance(const UnitGroups& groups, std::size_t g, const LanePoint& point, LaneValues& result);

  /// sums[g][k] += weight (e_k share_k + indirect_k) for `count` groups, e being the irradiance, up to its cap
  /// if asked; share and indirect have a row of lanes for each of them, sums one for each group of all.
  static void add_irradiance(const UnitGroups& groups, const std::uint16_t* list, std::size_t count,
                             const LanePoint& point, bool is_capped, float weight, const float* share,
                             const float* indirect, float* sums);

  /// How much the sampling of shadow rays should care for each lane of a row: e (sqrt |share (1 - share)| +
  /// 0.1) + floor, e up to its cap if asked. Keeps the whole e in `irradiance`, the result in `importance`;
  /// returns its sum.
  static float importance(const UnitGroups& groups, const std::uint16_t* list, std::size_t count,
                          const LanePoint& point, bool is_capped, const float* share, float floor,
                          float* irradiance, float* importance);

  /// sums[list[c]][k] += weight values[c][k] for the rows of lanes of a list.
  static void add_listed(const std::uint16_t* list, std::size_t count, float weight, const float* values,
                         float* sums);

  /// sums[g][k] += weight values[g][k] for the listed groups.
  static void add(const std::uint16_t* list, std::size_t count, float weight, const float* values,
                  float* sums);
};

}  // namespace shelfbeam
