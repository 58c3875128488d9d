#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/transport/cache/profile_irradiance.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam {

/// Number of transceivers that vector instructions handle together: neighbours of one type, one lane each.
inline constexpr std::size_t lanes = 16;
using LaneValues = std::array<float, lanes>;

/// A point of a surface for vectorised code; the normal selects the side.
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

/// A hierarchy of two levels over the transceivers of a scene: groups of up to sixteen. Its results are
/// approximations in single precision (discs count as points, measured profiles by their mean over phi);
/// estimators that use them correct the difference.
class UnitGroups {
 public:
  explicit UnitGroups(const World& world);
  /// The units of a changed world, in the groups and lanes of `like`.
  UnitGroups(const World& changed, const UnitGroups& like);

  std::size_t size() const { return groups_.size(); }
  /// Column of the matrix in a lane; lanes from `count` on are padding without emission. Emitting surfaces
  /// come last, in groups without emission.
  std::uint32_t column(std::size_t g, std::size_t lane) const { return groups_[g].columns[lane]; }
  std::size_t count(std::size_t g) const { return groups_[g].count; }
  /// group x `lanes` + lane of a column.
  std::uint32_t lane_index(std::size_t column) const { return lane_indices_[column]; }

  /// Whether a unit, because it is a disc or has a tabulated profile, may light points with `irradiance` 0.
  bool is_approximate(std::size_t g) const { return groups_[g].is_approximate; }
  bool any_approximate() const {
    return std::any_of(groups_.begin(), groups_.end(),
                       [](const Group& group) { return group.is_approximate; });
  }

  /// Unoccluded irradiance of each unit of a group, W/m^2.
  void irradiance(std::size_t g, const LanePoint& point, LaneValues& result) const;

  /// Limit on a unit's irradiance for rays that receivers send to surfaces (SpotRule), W/m^2; none unless
  /// set.
  float cap(std::size_t g, std::size_t lane) const { return groups_[g].cap[lane]; }
  void set_cap(std::size_t column, float cap);
  /// Largest radiant intensity, W/sr.
  float peak(std::size_t g) const { return groups_[g].peak; }

  /// Largest irradiance that a unit of the group could give at this distance in any direction; distances
  /// below Group::nearest count as this distance.
  float bound(std::size_t g, const LanePoint& point) const {
    const Group& group = groups_[g];
    const float away = std::max(group.nearest, distance(g, point));
    return group.peak / (away * away);
  }
  /// Lower bound on the distance to the units of the group, m; may be negative.
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
    bool is_approximate = false;
    std::array<float, 3> centre{};
    float radius = 0, nearest = 0, peak = 0;
    float type_scale = 1, type_peak = 0;  ///< of a unit with the power of its type
  };
  static void place(Group& group, const Scene& scene);

  std::vector<Group> groups_;
  LaneValues no_cap_{};
  std::vector<std::uint32_t> lane_indices_;
  std::vector<float> tables_;  ///< intensity by (1 + cos theta) / 2, `table_steps` + 1 values per type
  static constexpr int table_steps = 512;
};

}  // namespace shelfbeam
