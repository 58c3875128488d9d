#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/inspection/checks.hpp"
#include "shelfbeam/material/material.hpp"
#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/scene/plan_parts.hpp"

namespace shelfbeam {

namespace {

// m by which fixtures that touch may overlap: cabinets have walls beyond their nominal length.
constexpr double contact = 0.05;

double overlap(const Part& one, const Part& other) {
  return std::min(std::min(one.top, other.top) - std::max(one.bottom, other.bottom),
                  overlap_depth(one.footprint, other.footprint));
}

// The share of the smaller or the larger of two upright boxes that is inside the other.
double shared_volume(const Part& one, const Part& other, bool of_larger) {
  const Bounds a = bounds_of(one), b = bounds_of(other);
  double shared = 1, first = 1, second = 1;
  for (int axis = 0; axis < 3; ++axis) {
    shared *= std::max(0.0, std::min(a.high[axis], b.high[axis]) - std::max(a.low[axis], b.low[axis]));
    first *= a.high[axis] - a.low[axis];
    second *= b.high[axis] - b.low[axis];
  }
  return shared / (of_larger ? std::max(first, second) : std::min(first, second));
}

class Overlaps {
 public:
  Overlaps(const Inspected& store, WarningList& warnings)
      : store_(store), warnings_(warnings), is_reported_(store.scene.fixtures.size()) {}

  void check() {
    for (const Part* block : store_.blocks.all()) check_block(*block);
    for (const Part& part : store_.scene.parts)
      if (part.kind == PartKind::mesh) check_mesh(part);
    if (budget_ == 0 || store_.blocks.is_exhausted())
      warnings_.add(FindingCode::overlap_unchecked, store_.store.file + ": fixtures",
                    "too many fixtures lie close together to check all of them for "
                    "overlaps; check their positions on the floor plan");
  }

 private:
  // The check ends after this number of pairs, because a store of n fixtures has up to n^2 / 2.
  static constexpr std::size_t max_pairs = 20'000'000;

  bool is_box(const Part& part) const {
    const FixtureForm form = form_of(part);
    return form == FixtureForm::block || form == FixtureForm::prism || form == FixtureForm::wall;
  }

  FixtureForm form_of(const Part& part) const { return store_.scene.fixtures[part.fixture].form; }

  bool is_plinth(const Part& part) const {
    constexpr double highest = 0.2;  // m
    return part.top - store_.floor() <= highest;
  }

  // Up to the ceiling over it, which may be lower than others.
  bool is_column(const Part& part) const {
    constexpr double largest = 1.5, reach = 0.8;  // m^2
    if (form_of(part) == FixtureForm::wall || std::abs(signed_area(part.footprint)) > largest) return false;
    const Bounds box = bounds_of(part);
    const Vec2 middle{(box.low.x + box.high.x) / 2, (box.low.y + box.high.y) / 2};
    const auto& room = store_.scene.room;
    const double ceiling = room ? room->ceiling_over(middle).at(middle) : store_.scene.upper.z;
    return part.top - part.bottom > reach * (ceiling - store_.floor());
  }

  // Shelves stand on plinths and around columns, walls join, walls and columns that are drawn as boxes cross,
  // and columns stand in walls.
  bool may_overlap(const Part& one, const Part& other) const {
    if (form_of(one) == FixtureForm::wall && form_of(other) == FixtureForm::wall) return true;
    if (is_box(one) && is_box(other))
      return shared_volume(one, other, false) < 0.5 ||
             ((is_column(one) || is_column(other)) && shared_volume(one, other, true) < 0.5);
    const auto is_part_of_building = [&](const Part& part) {
      return (is_box(part) || form_of(part) == FixtureForm::mesh) && (is_plinth(part) || is_column(part));
    };
    return is_part_of_building(one) || is_part_of_building(other);
  }

  // Whether a pair may still be checked.
  bool takes_pair(const Part& one, const Part& other) {
    store_.expect_running();
    if (one.fixture == other.fixture || is_reported_[one.fixture] || budget_ == 0) return false;
    --budget_;
    return true;
  }

  // Reports one overlap per fixture. Returns true, so that a search ends.
  bool report(const Part& one, const Part& other) {
    is_reported_[one.fixture] = is_reported_[other.fixture] = true;
    const std::string& where = store_.sources.fixtures[one.fixture];
    warnings_.add(FindingCode::fixture_overlap, where,
                  "fixture '{}' overlaps fixture '{}'; fixtures usually stand side by side; "
                  "move one of them, or remove a duplicate",
                  store_.scene.fixtures[one.fixture].id, store_.scene.fixtures[other.fixture].id);
    return true;
  }

  void check_block(const Part& block) {
    if (is_reported_[block.fixture]) return;
    store_.blocks.any(bounds_of(block).wider_by(-contact), [&](const Part& other) {
      if (&other > &block || !takes_pair(block, other)) return budget_ == 0;
      return !may_overlap(block, other) && overlap(block, other) > contact && report(block, other);
    });
  }

  const Vec3& corner(std::uint32_t triangle, std::size_t k) const {
    const TriangleMesh& mesh = store_.scene.mesh;
    return mesh.vertices[mesh.triangles[triangle][k % 3]];
  }

  // Edges of the mesh inside a block, and edges of a block through the mesh.
  void check_mesh(const Part& mesh) {
    for (std::uint32_t t = mesh.first_triangle; t < mesh.first_triangle + mesh.triangle_count; ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 &a = corner(t, k), &b = corner(t, k + 1);
        const double size = length(b - a);
        if (!(size > contact) || is_reported_[mesh.fixture]) continue;
        Bounds edge;
        edge.include(a);
        edge.include(b);
        const Vec3 direction = (b - a) / size;
        store_.blocks.any(edge, [&](const Part& block) {
          if (may_overlap(mesh, block) || !takes_pair(mesh, block)) return budget_ == 0;
          const Stretch stretch = stretch_within(block, a, direction, contact);
          return std::min(stretch.end, size) - std::max(stretch.begin, 0.0) > contact && report(mesh, block);
        });
      }
    store_.blocks.any(bounds_of(mesh).wider_by(-contact), [&](const Part& block) {
      if (!takes_pair(block, mesh)) return budget_ == 0;
      if (!may_overlap(block, mesh) && crosses(block, mesh)) report(block, mesh);
      return false;
    });
  }

  // Whether an edge or a diagonal of the block, slightly inside it, meets a triangle of the mesh.
  bool crosses(const Part& block, const Part& mesh) const {
    const std::size_t corners = block.footprint.size();
    const double inset = std::min(contact, 0.45 * (block.top - block.bottom));
    Vec3 middle;
    for (const auto& [x, y] : block.footprint) middle = middle + Vec3{x, y, 0} / static_cast<double>(corners);
    std::vector<Vec3> low, high;
    for (const auto& [x, y] : block.footprint) {
      const Vec3 inwards = middle - Vec3{x, y, 0};
      const double way = length(inwards);
      const Vec3 q = Vec3{x, y, 0} + inwards * (way > 0 ? std::min(0.9, 1.5 * contact / way) : 0);
      low.push_back(q + Vec3{0, 0, block.bottom + inset});
      high.push_back(q + Vec3{0, 0, block.top - inset});
    }
    for (std::size_t k = 0; k < corners; ++k) {
      const std::size_t next = (k + 1) % corners, opposite = (k + corners / 2) % corners;
      for (const auto& [a, b] : {std::pair(low[k], high[k]), std::pair(low[k], low[next]),
                                 std::pair(high[k], high[next]), std::pair(low[k], high[opposite])})
        if (meets(a, b, mesh)) return true;
    }
    return false;
  }

  bool meets(const Vec3& a, const Vec3& b, const Part& mesh) const {
    constexpr int max_surfaces = 16;
    const double size = length(b - a);
    if (!(size > contact)) return false;
    const Vec3 direction = (b - a) / size;
    SurfacePoint from{a, direction};
    for (int k = 0; k < max_surfaces; ++k) {
      const auto hit = store_.rays.intersect(from, direction);
      if (!hit || dot(hit->point.position - a, direction) >= size) return false;
      if (hit->point.triangle - mesh.first_triangle < mesh.triangle_count) return true;
      from = hit->point;
    }
    return false;
  }

  const Inspected& store_;
  WarningList& warnings_;
  std::vector<bool> is_reported_;
  std::size_t budget_ = max_pairs;
};

bool is_near(const Polygon& one, const Polygon& other, double distance) {
  const auto has_corner_near = [&](const Polygon& corners, const Polygon& border) {
    return std::any_of(corners.begin(), corners.end(),
                       [&](const Vec2& p) { return distance_to_border(border, p) <= distance; });
  };
  return has_corner_near(one, other) || has_corner_near(other, one);
}

// Whether a part touches a wall or the ceiling, or extends beyond them.
bool touches_room(const Scene& scene, const Part& part) {
  if (!scene.room) {
    const Bounds near = bounds_of(part).wider_by(contact);
    return near.low.x < scene.lower.x || near.low.y < scene.lower.y || near.high.x > scene.upper.x ||
           near.high.y > scene.upper.y || near.high.z > scene.upper.z;
  }
  const RoomShape& room = *scene.room;
  const std::vector<PlanPart> parts = plan_parts(room, part.footprint);
  return leave_room(parts) || part.top > lowest_ceiling(parts) - contact ||
         is_near(part.footprint, room.outline, contact) ||
         std::any_of(room.holes.begin(), room.holes.end(),
                     [&](const Polygon& hole) { return is_near(part.footprint, hole, contact); });
}

// A block above the floor that nothing supports. Signs and lamps are small or high.
void warn_of_floating(const Inspected& store, WarningList& warnings) {
  constexpr double largest_sign = 0.3, headroom = 2;
  const Scene& scene = store.scene;
  std::vector<const Part*> meshes;
  for (const Part& part : scene.parts)
    if (part.kind == PartKind::mesh) meshes.push_back(&part);
  const BoxIndex mesh_index = index_of(meshes);
  for (const Part& block : scene.parts) {
    store.expect_running();
    // Inner walls follow the fixtures of the store.
    if (block.fixture >= store.store.fixtures.size()) break;
    const std::string_view keys = height_keys(store.store.fixtures[block.fixture].value);
    const double bottom = block.bottom - store.floor();
    if (keys.empty() || bottom < 0.05 || bottom > headroom ||
        std::abs(signed_area(block.footprint)) < largest_sign ||
        !is_opaque(scene.materials[block.material.value].material))
      continue;
    const Bounds near = bounds_of(block).wider_by(contact);
    const auto touches = [&](const Part& other) { return other.fixture != block.fixture; };
    if (mesh_index.any(near, [&](std::uint32_t k) { return touches(*meshes[k]); }) ||
        touches_room(scene, block) || store.blocks.any(near, touches) || store.blocks.is_exhausted())
      continue;
    const std::string& where = store.sources.fixtures[block.fixture];
    warnings.add(FindingCode::fixture_floating, where,
                 "fixture '{}' floats {:.2g} m above the floor; a fixture stands on the floor or "
                 "touches a wall, the ceiling or another fixture; correct {}",
                 scene.fixtures[block.fixture].id, bottom, keys);
  }
}

// The bounds of the meshes, by fixture; empty bounds for other fixtures.
std::vector<Bounds> bounds_of_meshes(const Scene& scene) {
  std::vector<Bounds> meshes(scene.fixtures.size());
  for (const Part& part : scene.parts)
    if (part.kind == PartKind::mesh) meshes[part.fixture].include(bounds_of(part));
  return meshes;
}

// The same mesh twice at the same place.
void warn_of_copies(const Inspected& store, WarningList& warnings) {
  constexpr double same = 0.01;
  std::vector<Bounds> meshes = bounds_of_meshes(store.scene);
  const auto is_mesh = [&](std::size_t f) { return meshes[f].low.x <= meshes[f].high.x; };
  const auto differs = [&](const Vec3& a, const Vec3& b) { return length(a - b) > same; };
  for (std::size_t f = 0; f < meshes.size(); ++f) {
    store.expect_running();
    for (std::size_t first = 0; is_mesh(f) && first < f; ++first) {
      if (!is_mesh(first) || differs(meshes[first].low, meshes[f].low) ||
          differs(meshes[first].high, meshes[f].high))
        continue;
      warnings.add(FindingCode::mesh_twice, store.sources.fixtures[f],
                   "mesh '{}' has the place and the size of mesh '{}'; usually each mesh is placed once; "
                   "remove one of them",
                   store.scene.fixtures[f].id, store.scene.fixtures[first].id);
      break;
    }
  }
}

void warn_of_scale(const Inspected& store, WarningList& warnings) {
  constexpr double smallest = 0.05, largest = 300;
  const std::vector<Bounds> meshes = bounds_of_meshes(store.scene);
  for (std::size_t f = 0; f < meshes.size(); ++f) {
    const Vec3 size = meshes[f].high - meshes[f].low;
    const double extent = std::max({size.x, size.y, size.z});
    if (!std::isfinite(extent) || (extent >= smallest && extent <= largest)) continue;
    warnings.add(FindingCode::mesh_size, store.sources.fixtures[f] + ".scale",
                 "mesh '{}' extends {:.2g} m; 0.1 to 100 m are typical; give the metres per unit "
                 "of length of its file, such as 0.001 for millimetres",
                 store.scene.fixtures[f].id, extent);
  }
}

double rotation_deg(const Fixture& fixture) {
  return std::visit(
      [](const auto& one) {
        if constexpr (!requires { one.rotation_deg; })
          return 0.0;
        else
          return one.rotation_deg;
      },
      fixture);
}

// 0.785, 1.57, 3.14 and so on: fixtures stand at such fractions of a turn, and hardly at 1.57 degrees.
void warn_of_radians(const Inspected& store, WarningList& warnings) {
  for (const auto& [fixture, where] : store.store.fixtures) {
    const double angle = rotation_deg(fixture), eighths = std::round(angle / (pi / 4));
    if (eighths == 0 || std::abs(eighths) > 8 || std::abs(angle - eighths * pi / 4) > 0.004) continue;
    warnings.add(FindingCode::rotation_in_radians, where + ".rotation_deg",
                 "is {:g}, which is {:g} degrees in radians; 0, 90, 180 and 270 are "
                 "typical; give degrees",
                 angle, eighths * 45);
  }
}

}  // namespace

void warn_of_fixtures(const Inspected& store, WarningList& warnings) {
  Overlaps(store, warnings).check();
  warn_of_copies(store, warnings);
  warn_of_floating(store, warnings);
  warn_of_scale(store, warnings);
  warn_of_radians(store, warnings);
}

}  // namespace shelfbeam
