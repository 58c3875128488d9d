#include "shelfbeam/scene/glb/scene_glb.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include "shelfbeam/material/material_shares.hpp"
#include "shelfbeam/math/frame.hpp"
#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/scene/glb/glb_file.hpp"

namespace shelfbeam {

namespace {

// m
constexpr double point_width = 0.05, point_height = 0.03;  // of labels that are points
constexpr double lift = 0.001;                             // of labels in front of the surface they are on
constexpr double unit_radius = 0.05, unit_tip = 0.12, unit_back = 0.02;  // the back is short for ceilings

GlbMaterial look_of(const NamedMaterial& named) {
  const auto given = given_reflectance(named.material);
  const double grey = given ? *given : shares_at_normal(named.material).reflected;
  // Glass reflects so little that it would look black. So would pure metal, which shows only its
  // surroundings, in viewers that have none.
  if (!is_opaque(named.material)) return {named.name, {0.8, 0.8, 0.8}, 0, 0.1, 0.25};
  if (std::holds_alternative<Conductor>(named.material)) return {named.name, {grey, grey, grey}, 0.5, 0.5};
  return {named.name, {grey, grey, grey}};
}

/// The triangles of a node, one surface per material in the order of their first triangles.
class NodeSurfaces {
 public:
  explicit NodeSurfaces(const Scene& scene) : mesh_(scene.mesh) {}

  void add(std::size_t triangle) {
    const std::size_t material = mesh_.materials[triangle].value;
    const auto [found, is_new] = surface_of_.emplace(material, surfaces_.size());
    if (is_new) surfaces_.push_back({material, {}, {}});
    GlbSurface& surface = surfaces_[found->second];
    const auto& [a, b, c] = mesh_.triangles[triangle];
    surface.triangles.push_back({vertex(surface, a), vertex(surface, b), vertex(surface, c)});
  }
  const std::vector<GlbSurface>& all() const { return surfaces_; }

 private:
  // The number, within the surface, of a vertex of the scene.
  std::uint32_t vertex(GlbSurface& surface, std::uint32_t in_scene) {
    const auto next = static_cast<std::uint32_t>(surface.vertices.size());
    const auto [found, is_new] = known_[surface.material].emplace(in_scene, next);
    if (is_new) surface.vertices.push_back(mesh_.vertices[in_scene]);
    return found->second;
  }

  const TriangleMesh& mesh_;
  std::vector<GlbSurface> surfaces_;
  std::map<std::size_t, std::size_t> surface_of_;                                  // by material
  std::map<std::size_t, std::unordered_map<std::uint32_t, std::uint32_t>> known_;  // by material
};

/// Whether a triangle of the room is neither an upright wall nor the floor, which is at height 0.
bool is_ceiling(const TriangleMesh& mesh, std::size_t triangle) {
  const auto& [i, j, k] = mesh.triangles[triangle];
  const Vec3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
  const Vec3 normal = cross(b - a, c - a);
  return a.z + b.z + c.z > 0 && std::abs(normal.z) > 1e-6 * length(normal);
}

void add_unless_empty(GlbFile& file, const std::string& name, const std::vector<GlbSurface>& surfaces) {
  const auto is_empty = [](const GlbSurface& surface) { return surface.triangles.empty(); };
  if (!std::all_of(surfaces.begin(), surfaces.end(), is_empty)) file.add_node(name, surfaces);
}

// The zone to which a triangle of the room belongs: its ceiling, or the upright face at its border.
std::optional<std::size_t> zone_of(const Scene& scene, std::size_t triangle, bool is_ceiling) {
  constexpr double rounding = 1e-6;  // m
  const RoomShape& room = *scene.room;
  const auto& [i, j, k] = scene.mesh.triangles[triangle];
  const auto& v = scene.mesh.vertices;
  const Vec3 middle = (v[i] + v[j] + v[k]) / 3;
  const Vec2 plan{middle.x, middle.y};
  const auto is_on = [&](const Polygon& border) { return distance_to_border(border, plan) < rounding; };
  if (!is_ceiling && (middle.z < rounding || is_on(room.outline) ||
                      std::any_of(room.holes.begin(), room.holes.end(), is_on)))
    return {};
  for (std::size_t z = 0; z < room.zones.size(); ++z)
    if (is_ceiling ? contains(room.zones[z].polygon, plan) : is_on(room.zones[z].polygon)) return z;
  return {};
}

void add_room(GlbFile& file, const Scene& scene) {
  std::vector<bool> is_of_fixture(scene.mesh.triangles.size(), false);
  for (const FixtureOutline& fixture : scene.fixtures)
    for (std::uint32_t k = 0; k < fixture.triangle_count; ++k)
      is_of_fixture[fixture.first_triangle + k] = true;
  NodeSurfaces room(scene), ceiling(scene);
  std::vector<NodeSurfaces> zones(scene.room ? scene.room->zones.size() : 0, NodeSurfaces(scene));
  for (std::size_t t = 0; t < is_of_fixture.size(); ++t) {
    if (is_of_fixture[t]) continue;
    const bool is_above = is_ceiling(scene.mesh, t);
    const auto zone = zones.empty() ? std::nullopt : zone_of(scene, t, is_above);
    (zone ? zones[*zone] : is_above ? ceiling : room).add(t);
  }
  add_unless_empty(file, "room", room.all());
  add_unless_empty(file, "ceiling", ceiling.all());
  for (std::size_t z = 0; z < zones.size(); ++z)
    add_unless_empty(file, "ceiling " + scene.room->zones[z].id, zones[z].all());
}

void add_fixtures(GlbFile& file, const Scene& scene) {
  for (const FixtureOutline& fixture : scene.fixtures) {
    NodeSurfaces surfaces(scene);
    for (std::uint32_t k = 0; k < fixture.triangle_count; ++k) surfaces.add(fixture.first_triangle + k);
    file.add_node(fixture.id, surfaces.all());
  }
}

/// Adds a closed or open shape to a surface, its faces counter-clockwise seen from outside.
void add_shape(GlbSurface& surface, const std::vector<Vec3>& corners,
               const std::vector<std::array<std::uint32_t, 3>>& faces) {
  const auto first = static_cast<std::uint32_t>(surface.vertices.size());
  surface.vertices.insert(surface.vertices.end(), corners.begin(), corners.end());
  for (const auto& [a, b, c] : faces) surface.triangles.push_back({first + a, first + b, first + c});
}

void add_labels(GlbFile& file, const Scene& scene, std::size_t material) {
  GlbSurface surface{material, {}, {}};
  for (const Label& label : scene.labels) {
    const auto& [width, height] = scene.type_of(label).size;
    const Frame frame = Frame::of_surface(label.normal);
    const Vec3 right = frame.x * ((width > 0 ? width : point_width) / 2);
    const Vec3 up = frame.y * ((height > 0 ? height : point_height) / 2);
    const Vec3 p = label.position + label.normal * lift;
    add_shape(surface, {p - right - up, p + right - up, p + right + up, p - right + up},
              {{0, 1, 2}, {0, 2, 3}});
  }
  add_unless_empty(file, "labels", {surface});
}

void add_transceivers(GlbFile& file, const Scene& scene, bool installed, std::size_t material) {
  GlbSurface surface{material, {}, {}};
  for (const Transceiver& unit : scene.transceivers) {
    if (unit.installed != installed) continue;
    const Frame frame = Frame::about(unit.axis);
    const Vec3 &p = unit.position, x = frame.x * unit_radius, y = frame.y * unit_radius;
    add_shape(surface, {p + x, p + y, p - x, p - y, p + unit.axis * unit_tip, p - unit.axis * unit_back},
              {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}});
  }
  add_unless_empty(file, installed ? "installed" : "candidates", {surface});
}

}  // namespace

std::string scene_glb(const Scene& scene) {
  GlbFile file(scene.name.empty() ? "store" : scene.name);
  for (const NamedMaterial& material : scene.materials) file.add_material(look_of(material));
  // The colours of the floor plan: blue, brown and black.
  const std::size_t label = file.add_material({"label", {0.003, 0.074, 0.283}});
  const std::size_t candidate = file.add_material({"candidate", {0.254, 0.07, 0}});
  const std::size_t installed = file.add_material({"installed", {0.007, 0.01, 0.013}});
  add_room(file, scene);
  add_fixtures(file, scene);
  add_labels(file, scene, label);
  add_transceivers(file, scene, false, candidate);
  add_transceivers(file, scene, true, installed);
  return file.bytes();
}

}  // namespace shelfbeam
