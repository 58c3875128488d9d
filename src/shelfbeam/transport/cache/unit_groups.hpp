#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam {

/// Transceivers met together: neighbours of one type, a lane of the processor's vectors each.
inline constexpr std::size_t lanes = 16;
using LaneValues = std::array<float, lanes>;

/// Emission profiles for which there is vectorised code.
enum class LaneProfile { sine, isotropic, lambertian, table };

/// A point of a surface as the vectorised code has it; the normal is that of the side that is meant.
struct LanePoint {
  float x, y, z, nx, ny, nz;

  explicit LanePoint(const SurfacePoint& p)
      : x(static_cast<float>(p.position.x)),
        y(static_cast<float>(p.position.y)),
        z(static_cast<float>(p.position.z)),
        nx(static_cast<float>(p.normal.x)),
        ny(static_cast<float>(p.normal.y)),
        nz(static_cast<float>(p.normal.z)) {}
};

/// A hierarchy of two levels over the transceivers of a scene: groups of up to sixteen. What it computes is a
/// guide in single precision (discs are taken for points, measured profiles for their mean over phi):
/// estimators that use it correct for what it leaves out.
class UnitGroups {
 public:
  explicit UnitGroups(const World& world);

  std::size_t size() const { return groups_.size(); }
  /// Column of the matrix in a lane; lanes beyond `count` are padding that shines nowhere. Emitting surfaces
  /// come last, in groups that give nothing.
  std::uint32_t column(std::size_t g, std::size_t lane) const { return groups_[g].columns[lane]; }
  std::size_t count(std::size_t g) const { return groups_[g].count; }
  /// group x lanes + lane of a column.
  std::uint32_t place(std::size_t column) const { return places_[column]; }

  /// Whether a unit may send light to a point where `irradiance` is zero: by its size or a table.
  bool is_loose(std::size_t g) const { return groups_[g].is_loose; }
  bool any_loose() const {
    return std::any_of(groups_.begin(), groups_.end(), [](const Group& group) { return group.is_loose; });
  }

  /// Irradiance in W/m^2 that each unit of a group would give with nothing in between.
  void irradiance(std::size_t g, const LanePoint& point, LaneValues& result) const;

  /// What estimators that look at surfaces from afar take of a unit's irradiance at most: SpotRule. No limit
  /// unless set.
  float cap(std::size_t g, std::size_t lane) const { return groups_[g].cap[lane]; }
  void set_cap(std::size_t column, float cap);
  /// Largest radiant intensity, W/sr.
  float peak(std::size_t g) const { return groups_[g].peak; }

  /// Largest irradiance that a unit of the group could give anywhere at this distance, and more than nothing.
  float bound(std::size_t g, const LanePoint& point) const {
    const Group& group = groups_[g];
    const float away = std::max(group.nearest, distance(g, point));
    return group.peak / (away * away);
  }
  /// No unit of the group is nearer, m; may be negative.
  float distance(std::size_t g, const LanePoint& point) const {
    const Group& group = groups_[g];
    const float dx = point.x - group.centre[0], dy = point.y - group.centre[1],
                dz = point.z - group.centre[2];
    return std::sqrt(dx * dx + dy * dy + dz * dz) - group.radius;
  }

 private:
  friend struct LaneKernels;
  struct Group {
    alignas(64) LaneValues x{}, y{}, z{}, ax{}, ay{}, az{}, scale{}, cap{};
    std::array<std::uint32_t, lanes> columns{};
    std::size_t count = 0;
    LaneProfile profile = LaneProfile::table;
    std::uint32_t table = 0;  ///< offset into tables_
    bool is_loose = false;
    std::array<float, 3> centre{};
    float radius = 0, nearest = 0, peak = 0;
  };
  std::vector<Group> groups_;
  LaneValues no_cap_{};
  std::vector<std::uint32_t> places_;
  std::vector<float> tables_;  ///< intensity by (1 + cos theta) / 2, `table_steps` + 1 values each
  static constexpr int table_steps = 512;
};

}  // namespace shelfbeam
