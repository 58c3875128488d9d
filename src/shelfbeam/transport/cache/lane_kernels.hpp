#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/transport/cache/surface_guide.hpp"
#include "shelfbeam/transport/cache/unit_groups.hpp"

namespace shelfbeam {

/// Packs shares into one byte and irradiances into two; a radiance cache has hundreds of millions of them.
struct PackedLane {
  static std::uint8_t pack_share(float share) {
    return static_cast<std::uint8_t>(std::lround(std::min(share, 1.99F) * 128));
  }
  static float share(std::uint8_t packed) { return static_cast<float>(packed) * (1.0F / 128); }
  /// The upper half of a float.
  static std::uint16_t pack(float value) {
    return static_cast<std::uint16_t>((std::bit_cast<std::uint32_t>(value) + 0x8000) >> 16);
  }
  static float value(std::uint16_t packed) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(packed) << 16);
  }
};

/// The inner loops over lanes, compiled for several instruction sets. `list` contains indices of groups.
struct LaneKernels {
  /// UnitGroups::irradiance.
  static void irradiance(const UnitGroups& groups, std::size_t g, const LanePoint& point, LaneValues& result);

  /// sums[g][k] += weight (e_k share_k + indirect_k) for the `count` groups g of `list`; e is the irradiance,
  /// with `is_capped` limited to its cap. share and indirect have a row per listed group, sums a row per
  /// group.
  static void add_irradiance(const UnitGroups& groups, const std::uint16_t* list, std::size_t count,
                             const LanePoint& point, bool is_capped, float weight, const std::uint8_t* share,
                             const std::uint16_t* indirect, float* sums);

  /// The same for radiance: sums[g][k] += weight (f_k e_k share_k + indirect_factor indirect_k), f by
  /// `scatter`.
  static void add_radiance(const UnitGroups& groups, const std::uint16_t* list, std::size_t count,
                           const LanePoint& point, const LaneScatter& scatter, bool is_capped, float weight,
                           float indirect_factor, const std::uint8_t* share, const std::uint16_t* indirect,
                           float* sums);

  /// The parts of f for one unit: entry(cos l) and the highlight.
  struct Parts {
    float entry, highlight;
  };
  static Parts parts(const UnitGroups& groups, std::size_t g, std::size_t lane, const LanePoint& point,
                     const LaneScatter& scatter);

  /// Importance of each lane for the sampling of shadow rays: e (sqrt |share (1 - share)| + 0.05) + floor x
  /// UnitGroups::bound. With `is_capped`, e is limited to its cap; with `scatter`, e is multiplied by 1 + pi
  /// times the highlight. Writes the unlimited e to `irradiance` and the result to `importance`; returns the
  /// sum of the importances.
  static float importance(const UnitGroups& groups, const std::uint16_t* list, std::size_t count,
                          const LanePoint& point, bool is_capped, const std::uint8_t* share, float floor,
                          const LaneScatter* scatter, float* irradiance, float* importance);

  /// sums[list[c]][k] += weight values[c][k] for the packed rows of lanes of a list.
  static void add_listed(const std::uint16_t* list, std::size_t count, float weight,
                         const std::uint16_t* values, float* sums);

  /// to[k] += weight from[k] for `count` packed rows of lanes.
  static void add_packed(std::size_t count, float weight, const std::uint16_t* from, float* to);

  /// sums[g][k] += weight values[g][k] for the listed groups.
  static void add(const std::uint16_t* list, std::size_t count, float weight, const float* values,
                  float* sums);
};

/// A value for every unit; only the groups in use are not zero.
class LaneRow {
 public:
  explicit LaneRow(std::size_t groups) : values_(groups * lanes), is_used_(groups) { used_.reserve(groups); }

  const std::vector<std::uint16_t>& groups() const { return used_; }
  const float* values() const { return values_.data(); }

  void clear() {
    for (const std::uint16_t g : used_) {
      is_used_[g] = 0;
      for (std::size_t k = 0; k < lanes; ++k) values_[g * lanes + k] = 0;
    }
    used_.clear();
  }

  void use(const std::uint16_t* list, std::size_t count) {
    for (std::size_t c = 0; c < count; ++c) {
      if (is_used_[list[c]]) continue;
      is_used_[list[c]] = 1;
      used_.push_back(list[c]);
    }
  }
  void add(std::uint32_t lane_index, double value) {
    const auto g = static_cast<std::uint16_t>(lane_index / lanes);
    use(&g, 1);
    values_[lane_index] += static_cast<float>(value);
  }
  void add(const LaneRow& other, double weight) {
    use(other.used_.data(), other.used_.size());
    LaneKernels::add(other.used_.data(), other.used_.size(), static_cast<float>(weight), other.values(),
                     values_.data());
  }
  float* mutable_values() { return values_.data(); }

 private:
  std::vector<float> values_;
  std::vector<std::uint8_t> is_used_;
  std::vector<std::uint16_t> used_;
};

}  // namespace shelfbeam
