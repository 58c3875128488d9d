#include "shelfbeam/scene/build/mount_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/math/warp.hpp"

namespace shelfbeam {

namespace {

constexpr double rounding = 1e-9;  // m

std::size_t steps(double extent, double spacing) {
  return static_cast<std::size_t>(std::max(1L, std::lround(extent / spacing)));
}

class Generator {
 public:
  Generator(const Store& store, const Scene& scene,
            const std::function<void(const Transceiver&, const std::string&)>& use)
      : store_(store), scene_(scene), use_(use) {}

  void generate() {
    for (std::size_t a = 0; a < store_.areas.size(); ++a) add_area(a);
    for (const auto& [rail, where] : store_.rails) add_rail(rail, where);
    for (const auto& [faces, where] : store_.faces) add_faces(faces, where);
  }

 private:
  void add(const MountedType& mounted, const std::string& id, const Vec3& position,
           const std::string& where) const {
    for (std::size_t a = 0; a < mounted.axes.size(); ++a) {
      Transceiver unit;
      unit.id = mounted.axes.size() == 1 ? id : fmt::format("{}/a{}", id, a + 1);
      unit.position = position;
      unit.axis = mounted.axes[a];
      unit.roll_deg = mounted.roll_deg;
      unit.type = mounted.type;
      use_(unit, where);
    }
  }

  bool is_free(const Vec3& p) const {
    if (scene_.room && !scene_.room->beyond(p, rounding).empty()) return false;
    return std::none_of(scene_.parts.begin(), scene_.parts.end(), [&](const Part& part) {
      return scene_.fixtures[part.fixture].type == "wall" && part.bottom < p.z && p.z < part.top &&
             contains(part.footprint, {p.x, p.y});
    });
  }

  const Polygon& polygon_of(const MountArea& mount) const {
    if (const auto* polygon = std::get_if<Polygon>(&mount.area)) return *polygon;
    const std::string& name = std::get<std::string>(mount.area);
    const RoomShape& room = *scene_.room;
    const auto zone = std::find_if(room.zones.begin(), room.zones.end(),
                                   [&](const CeilingZone& one) { return one.id == name; });
    return zone == room.zones.end() ? room.outline : zone->polygon;
  }

  // At the middle of each cell of a grid over the bounds of the area.
  void add_area(std::size_t index) const {
    const auto& [mount, where] = store_.areas[index];
    const Polygon& polygon = polygon_of(mount);
    const auto [low, high] = bounds_of(polygon);
    const std::size_t nx = steps(high[0] - low[0], mount.spacing),
                      ny = steps(high[1] - low[1], mount.spacing);
    const auto middle = [](double from, double to, std::size_t k, std::size_t n) {
      return from + (to - from) * (static_cast<double>(k) + 0.5) / static_cast<double>(n);
    };
    for (std::size_t iy = 0; iy < ny; ++iy)
      for (std::size_t ix = 0; ix < nx; ++ix) {
        const Vec2 p{middle(low[0], high[0], ix, nx), middle(low[1], high[1], iy, ny)};
        if (!contains(polygon, p) || !scene_.room->covers(p)) continue;
        const double z = mount.z.value_or(scene_.room->ceiling_over(p).at(p) - mount.below_ceiling);
        if (const Vec3 at{p[0], p[1], z}; is_free(at))
          add(mount.unit, fmt::format("A{}-{}-{}", index + 1, ix + 1, iy + 1), at, where);
      }
  }

  void add_rail(const MountRail& rail, const std::string& where) const {
    double whole = 0;
    for (std::size_t k = 1; k < rail.points.size(); ++k) whole += length(rail.points[k] - rail.points[k - 1]);
    const std::size_t count = steps(whole, rail.spacing);
    for (std::size_t k = 0; k <= count; ++k) {
      double left = whole * static_cast<double>(k) / static_cast<double>(count);
      std::size_t piece = 1;
      for (double one; piece + 1 < rail.points.size(); left -= one, ++piece) {
        one = length(rail.points[piece] - rail.points[piece - 1]);
        if (left <= one) break;
      }
      const Vec3 &from = rail.points[piece - 1], &to = rail.points[piece];
      const Vec3 at = k == count ? rail.points.back() : from + normalized(to - from) * left;
      add(rail.unit, fmt::format("{}-{}", rail.id, k + 1), at, where);
    }
  }

  void add_faces(const MountFaces& mount, const std::string& where) const {
    if (const auto* wall = std::get_if<std::size_t>(&mount.on)) {
      const Polygon& outline = scene_.room->outline;
      const std::array<Vec2, 2> edge{outline[*wall], outline[(*wall + 1) % outline.size()]};
      // Inside is to the left of a counter-clockwise outline.
      add_along(mount, edge, signed_area(outline) > 0 ? 1 : -1, fmt::format("wall-{}", *wall), where);
      return;
    }
    const std::string& id = std::get<std::string>(mount.on);
    for (const FixtureOutline& fixture : scene_.fixtures)
      if (fixture.id == id) {
        Polygon around = fixture.footprint;
        around.push_back(around.front());
        add_along(mount, around, signed_area(fixture.footprint) > 0 ? -1 : 1, id, where);
      }
  }

  // Along a line in plan; `side` is 1 if the units face its left.
  void add_along(const MountFaces& mount, std::span<const Vec2> line, double side, const std::string& id,
                 const std::string& where) const {
    const auto piece_length = [&](std::size_t k) {
      return std::hypot(line[k][0] - line[k - 1][0], line[k][1] - line[k - 1][1]);
    };
    double whole = 0;
    for (std::size_t k = 1; k < line.size(); ++k) whole += piece_length(k);
    const std::size_t count = steps(whole, mount.spacing);
    const double tilt = radians(mount.tilt_deg);
    for (std::size_t n = 0; n < count; ++n) {
      double left = whole * (static_cast<double>(n) + 0.5) / static_cast<double>(count);
      std::size_t k = 1;
      for (; k + 1 < line.size() && left > piece_length(k); ++k) left -= piece_length(k);
      const double x = (line[k][0] - line[k - 1][0]) / piece_length(k),
                   y = (line[k][1] - line[k - 1][1]) / piece_length(k);
      const Vec3 away{-side * y, side * x, 0};
      const Vec3 at =
          Vec3{line[k - 1][0] + left * x, line[k - 1][1] + left * y, mount.z} + away * mount.offset;
      if (!is_free(at)) continue;
      add({mount.type, {away * std::cos(tilt) - Vec3{0, 0, std::sin(tilt)}}, mount.roll_deg},
          fmt::format("{}-{}", id, n + 1), at, where);
    }
  }

  const Store& store_;
  const Scene& scene_;
  const std::function<void(const Transceiver&, const std::string&)>& use_;
};

}  // namespace

void generate_candidates(const Store& store, const Scene& scene,
                         const std::function<void(const Transceiver&, const std::string&)>& use) {
  Generator(store, scene, use).generate();
}

}  // namespace shelfbeam
