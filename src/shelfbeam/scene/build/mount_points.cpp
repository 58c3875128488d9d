#include "shelfbeam/scene/build/mount_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/math/box_index.hpp"
#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/scene/build/blocks.hpp"
#include "shelfbeam/scene/fixture/fixture_builder.hpp"

namespace shelfbeam {

namespace {

constexpr double mount_rounding = 1e-9;  // m
constexpr double contact = 1e-4;         // m from a face at which a unit is mounted on it

std::size_t steps(double extent, double spacing) {
  return static_cast<std::size_t>(std::max(1L, std::lround(extent / spacing)));
}

// The cells of a grid along one axis. Those before `begin` and from `end` on have their middle outside the
// room.
struct Cells {
  double low, extent;
  std::size_t count, begin, end;

  static Cells of(double low, double high, double room_low, double room_high, double spacing) {
    Cells cells{low, high - low, steps(high - low, spacing), 0, 0};
    const auto last = static_cast<double>(cells.count);
    const auto index = [&](double p) { return (p - low) / cells.extent * last - 0.5; };
    cells.begin = static_cast<std::size_t>(std::clamp(std::floor(index(room_low)), 0.0, last));
    cells.end = static_cast<std::size_t>(std::clamp(std::ceil(index(room_high)) + 1, 0.0, last));
    return cells;
  }
  std::size_t size() const { return end - begin; }
  double middle(std::size_t k) const {
    return low + extent * (static_cast<double>(k) + 0.5) / static_cast<double>(count);
  }
};

// A line of straight pieces, by the distance from its beginning.
class Path {
 public:
  explicit Path(std::vector<Vec3> points) : points_(std::move(points)) {
    for (std::size_t k = 1; k < points_.size(); ++k)
      ends_.push_back(ends_.back() + shelfbeam::length(points_[k] - points_[k - 1]));
  }

  struct Place {
    Vec3 position;
    std::size_t piece;  // from 0
  };
  double length() const { return ends_.back(); }
  const Vec3& last() const { return points_.back(); }
  /// Precondition: the length is not 0.
  Place at(double distance) const {
    const auto end = std::lower_bound(ends_.begin() + 1, ends_.end() - 1, distance);
    const auto k = static_cast<std::size_t>(end - ends_.begin());
    const Vec3 piece = points_[k] - points_[k - 1];
    const double extent = shelfbeam::length(piece);
    const Vec3 direction{piece.x / extent, piece.y / extent, piece.z / extent};
    return {points_[k - 1] + direction * (distance - ends_[k - 1]), k - 1};
  }

 private:
  std::vector<Vec3> points_;
  std::vector<double> ends_{0};  // by point
};

// The paths of candidates on the faces of a fixture or a wall, one piece per face. There are several paths if
// only some faces have candidates.
struct FacePaths {
  struct Run {
    Path path;
    std::vector<Vec2> outward;  // by piece; unit length
  };
  std::vector<Run> runs;
  double bottom = -HUGE_VAL, top = HUGE_VAL;  // m
  std::span<const Part> wall_parts;           // of an inner wall, which may have openings
  const RoomShape* room = nullptr;            // of an outer wall, which may have openings
  std::size_t wall = 0;                       // its number

  bool has_face(const Vec3& behind) const {
    if (behind.z < bottom || behind.z > top) return false;
    if (room != nullptr && room->is_open(wall, behind)) return false;
    return wall_parts.empty() || std::any_of(wall_parts.begin(), wall_parts.end(), [&](const Part& part) {
             return part.bottom <= behind.z && behind.z <= part.top &&
                    contains(part.footprint, {behind.x, behind.y});
           });
  }
};

std::vector<const Part*> wall_parts(const Scene& scene) {
  std::vector<const Part*> parts;
  for (const Part& part : scene.parts)
    if (scene.fixtures[part.fixture].is_wall()) parts.push_back(&part);
  return parts;
}

class Generator {
 public:
  Generator(const Store& store, const Scene& scene)
      : store_(store), scene_(scene), wall_parts_(wall_parts(scene)), wall_index_(index_of(wall_parts_)) {
    if (store.faces.empty()) return;
    for (std::size_t f = 0; f < scene.fixtures.size(); ++f) fixture_index_.emplace(scene.fixtures[f].id, f);
  }

  std::vector<MountCount> counts() const {
    std::vector<MountCount> result;
    const auto add = [&](std::size_t count, std::string_view id, const std::string& where) {
      result.push_back({count, static_cast<double>(count) * device_bytes_of(id), where, {}});
    };
    for (const auto& [mount, where] : store_.areas) {
      const auto [x, y] = cells(mount);
      add(x.size() * y.size() * mount.unit.axes.size(), "", where);
    }
    for (const auto& [rail, where] : store_.rails)
      add((steps(Path(rail.points).length(), rail.spacing) + 1) * rail.unit.axes.size(), rail.id, where);
    for (const auto& [faces, where] : store_.faces) {
      if (!is_built(faces)) continue;
      const FacePaths paths = face_paths(faces);
      std::size_t points = 0;
      for (const auto& run : paths.runs) points += count_along(faces, run.path);
      add(points * faces.tilts_deg.size(), faces.id, where);
      if (paths.runs.empty())
        result.back().fault = fmt::format("is {}, but all faces of {} look 45 degrees or more away from it",
                                          to_text(*faces.face), in_quotes(std::get<std::string>(faces.on)));
    }
    return result;
  }

  std::vector<EmptyMount> generate(const std::set<std::string>& omitted, const UseCandidate& use) const {
    std::vector<EmptyMount> empty;
    const auto expect_candidates = [&](const Outcome& outcome, const std::string& where) {
      if (!outcome.has_candidates) empty.push_back({where, "has no candidates: " + outcome.obstacle});
    };
    for (std::size_t g = 0; g < store_.grids.size(); ++g)
      if (!omitted.contains(store_.grids[g].where)) add_grid(g, use);
    for (std::size_t a = 0; a < store_.areas.size(); ++a)
      if (const std::string& where = store_.areas[a].where; !omitted.contains(where))
        expect_candidates(add_area(a, use), where);
    for (const auto& [rail, where] : store_.rails)
      if (!omitted.contains(where)) add_rail(rail, where, use);
    for (const auto& [faces, where] : store_.faces)
      if (is_built(faces) && !omitted.contains(where)) expect_candidates(add_faces(faces, where, use), where);
    return empty;
  }

 private:
  struct Outcome {
    bool has_candidates = false;
    std::string obstacle;  // to the first point

    void omit(const Vec3& p, const std::string& why) {
      if (obstacle.empty())
        obstacle = fmt::format("the point ({:.6g}, {:.6g}, {:.6g}) is {}", p.x, p.y, p.z, why);
    }
  };

  static void add(const MountedType& mounted, const std::string& id, const Vec3& position,
                  const std::string& where, const UseCandidate& use) {
    for (std::size_t a = 0; a < mounted.axes.size(); ++a) {
      Transceiver unit;
      unit.id = mounted.axes.size() == 1 ? id : fmt::format("{}/a{}", id, a + 1);
      unit.position = position;
      unit.axis = mounted.axes[a];
      unit.roll_deg = mounted.roll_deg;
      unit.type = mounted.type;
      use(unit, where);
    }
  }

  // The obstacle that would contain a candidate at this point, or the side of the room beyond which it would
  // be; empty if the point is free. Points on the sides of inner walls are free, but not those between a wall
  // and the ceiling.
  std::string obstacle_at(const Vec3& p) const {
    if (scene_.room)
      if (std::string side = scene_.room->beyond(p, mount_rounding); !side.empty()) return side;
    const std::string* wall = nullptr;
    wall_index_.any(Bounds{p, p}.wider_by(mount_rounding), [&](std::uint32_t k) {
      const Part& part = *wall_parts_[k];
      const Vec2 plan{p.x, p.y};
      if (part.bottom + mount_rounding < p.z && p.z < part.top + mount_rounding &&
          contains(part.footprint, plan) && distance_to_border(part.footprint, plan) > mount_rounding)
        wall = &scene_.fixtures[part.fixture].id;
      return wall != nullptr;
    });
    return wall == nullptr ? std::string() : "within the inner wall " + in_quotes(*wall);
  }

  void add_grid(std::size_t index, const UseCandidate& use) const {
    const auto& [grid, where] = store_.grids[index];
    const auto count = [&, &grid = grid](std::size_t axis) {
      const double extent = grid.max[axis] - grid.min[axis];
      return extent > 0 ? steps(extent, grid.spacing) : 0;
    };
    const auto coordinate = [&grid = grid](std::size_t axis, std::size_t k, std::size_t n) {
      return n == 0 ? grid.min[axis]
                    : grid.min[axis] +
                          (grid.max[axis] - grid.min[axis]) * static_cast<double>(k) / static_cast<double>(n);
    };
    const std::size_t nx = count(0), ny = count(1);
    for (std::size_t iy = 0; iy <= ny; ++iy)
      for (std::size_t ix = 0; ix <= nx; ++ix)
        add({grid.type, {grid.axis}, grid.roll_deg}, fmt::format("G{}-{}-{}", index + 1, ix + 1, iy + 1),
            {coordinate(0, ix, nx), coordinate(1, iy, ny), grid.z}, where, use);
  }

  // Along x and y.
  std::array<Cells, 2> cells(const MountArea& mount) const {
    const PlanBounds area = shelfbeam::bounds_of(polygon_of(mount.area, &*scene_.room)),
                     room = shelfbeam::bounds_of(scene_.room->outline);
    const auto along = [&](std::size_t axis) {
      return Cells::of(area.low[axis], area.high[axis], room.low[axis], room.high[axis], mount.spacing);
    };
    return {along(0), along(1)};
  }

  // At the middle of each cell of a grid over the bounds of the area.
  Outcome add_area(std::size_t index, const UseCandidate& use) const {
    const auto& [mount, where] = store_.areas[index];
    const Polygon& polygon = polygon_of(mount.area, &*scene_.room);
    const bool leaves_zones = leaves_out_zones(mount.area);
    const auto [x, y] = cells(mount);
    Outcome outcome;
    for (std::size_t iy = y.begin; iy < y.end; ++iy)
      for (std::size_t ix = x.begin; ix < x.end; ++ix) {
        const Vec2 p{x.middle(ix), y.middle(iy)};
        if (!contains(polygon, p) || !scene_.room->covers(p)) continue;
        if (leaves_zones && scene_.room->zone_over(p) != nullptr) continue;
        const double z = mount.z.value_or(scene_.room->ceiling_over(p).at(p) - mount.below_ceiling);
        const Vec3 at{p[0], p[1], z};
        if (const std::string obstacle = obstacle_at(at); !obstacle.empty()) {
          outcome.omit(at, obstacle);
          continue;
        }
        add(mount.unit, fmt::format("A{}-{}-{}", index + 1, ix + 1, iy + 1), at, where, use);
        outcome.has_candidates = true;
      }
    if (outcome.obstacle.empty())
      outcome.obstacle = "no point of its grid is within both the area and the room";
    return outcome;
  }

  static void add_rail(const MountRail& rail, const std::string& where, const UseCandidate& use) {
    const Path path(rail.points);
    const std::size_t count = steps(path.length(), rail.spacing);
    for (std::size_t k = 0; k <= count; ++k) {
      const double distance = path.length() * static_cast<double>(k) / static_cast<double>(count);
      const Vec3 at = k == count ? path.last() : path.at(distance).position;
      add(rail.unit, fmt::format("{}-{}", rail.id, k + 1), at, where, use);
    }
  }

  // The scene of a draft lacks fixtures that could not be built.
  bool is_built(const MountFaces& mount) const {
    const auto* id = std::get_if<std::string>(&mount.on);
    return id == nullptr || fixture_index_.contains(*id);
  }

  FacePaths face_paths(const MountFaces& mount) const {
    if (const auto* k = std::get_if<std::size_t>(&mount.on)) {
      const auto [from, to, inward] = scene_.room->wall(*k);
      Path path({{from[0], from[1], mount.z}, {to[0], to[1], mount.z}});
      return {{{std::move(path), {inward}}}, -HUGE_VAL, HUGE_VAL, {}, &*scene_.room, *k};
    }
    const auto index = static_cast<std::uint32_t>(fixture_index_.at(std::get<std::string>(mount.on)));
    const FixtureOutline& fixture = scene_.fixtures[index];
    FacePaths face{{}, HUGE_VAL, -HUGE_VAL, {}, nullptr, 0};
    add_runs(fixture.footprint, mount, face.runs);
    Part sought;
    sought.fixture = index;
    const auto [first, last] =
        std::equal_range(scene_.parts.begin(), scene_.parts.end(), sought,
                         [](const Part& a, const Part& b) { return a.fixture < b.fixture; });
    const std::span<const Part> parts(first, last);
    for (const Part& part : parts) {
      face.bottom = std::min(face.bottom, part.bottom);
      face.top = std::max(face.top, part.top);
    }
    if (fixture.is_wall()) face.wall_parts = parts;
    return face;
  }

  // All around a footprint, or along its edges towards a direction.
  static void add_runs(const Polygon& footprint, const MountFaces& mount, std::vector<FacePaths::Run>& runs) {
    std::vector<std::vector<std::size_t>> edges;
    if (mount.face) {
      edges = edges_towards(footprint, *mount.face);
    } else {
      edges.emplace_back(footprint.size());
      std::iota(edges.front().begin(), edges.front().end(), std::size_t{0});
    }
    const std::vector<Vec2> normals = outward_normals(footprint);
    const auto corner = [&](std::size_t k) {
      const Vec2& p = footprint[k % footprint.size()];
      return Vec3{p[0], p[1], mount.z};
    };
    for (const auto& run : edges) {
      std::vector<Vec3> points{corner(run.front())};
      std::vector<Vec2> outward;
      for (const std::size_t k : run) {
        points.push_back(corner(k + 1));
        outward.push_back(normals[k]);
      }
      runs.push_back({Path(std::move(points)), std::move(outward)});
    }
  }

  static std::size_t count_along(const MountFaces& mount, const Path& path) {
    return path.length() > 0 ? steps(path.length(), mount.spacing) : 0;
  }

  Outcome add_faces(const MountFaces& mount, const std::string& where, const UseCandidate& use) const {
    const FacePaths face = face_paths(mount);
    Outcome outcome;
    std::size_t number = 0;
    for (const auto& [path, outward] : face.runs) {
      const std::size_t count = count_along(mount, path);
      for (std::size_t n = 0; n < count; ++n) {
        ++number;
        const auto [point, piece] =
            path.at(path.length() * (static_cast<double>(n) + 0.5) / static_cast<double>(count));
        const Vec3 away{outward[piece][0], outward[piece][1], 0};
        const Vec3 at = point + away * std::max(mount.offset, contact);
        if (const std::string obstacle =
                face.has_face(point - away * contact) ? obstacle_at(at) : "not in front of a face";
            !obstacle.empty()) {
          outcome.omit(at, obstacle);
          continue;
        }
        MountedType unit{mount.type, {}, mount.roll_deg};
        for (const double tilt : mount.tilts_deg)
          unit.axes.push_back(away * std::cos(radians(tilt)) - Vec3{0, 0, std::sin(radians(tilt))});
        add(unit, fmt::format("{}-{}", mount.id, number), at, where, use);
        outcome.has_candidates = true;
      }
    }
    if (outcome.obstacle.empty()) outcome.obstacle = "the fixture has no faces";
    return outcome;
  }

  const Store& store_;
  const Scene& scene_;
  std::vector<const Part*> wall_parts_;
  BoxIndex wall_index_;
  std::unordered_map<std::string_view, std::size_t> fixture_index_;
};

}  // namespace

std::vector<MountCount> candidate_counts(const Store& store, const Scene& scene) {
  return Generator(store, scene).counts();
}

std::vector<EmptyMount> generate_candidates(const Store& store, const Scene& scene,
                                            const std::set<std::string>& omitted, const UseCandidate& use) {
  return Generator(store, scene).generate(omitted, use);
}

}  // namespace shelfbeam
