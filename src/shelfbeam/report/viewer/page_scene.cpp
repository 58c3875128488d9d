#include "shelfbeam/report/viewer/page_scene.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <vector>

#include <nlohmann/json.hpp>

#include "shelfbeam/material/material.hpp"

namespace shelfbeam {

namespace {

// Per mesh; larger meshes are drawn as prisms. About 1 MB in the page.
constexpr std::uint32_t max_mesh_triangles = 30000;

// The colour class of a part, as numbered by the script.
std::uint8_t colour_class_of(PartKind kind) {
  if (kind == PartKind::board || kind == PartKind::tub) return 1;
  return kind == PartKind::goods ? 2 : kind == PartKind::door ? 3 : 0;
}

void add_parts(PageData& page, const Scene& scene, bool has_states) {
  std::vector<std::uint8_t> look, corner_count, mesh_look;
  std::vector<float> corners, heights, mesh_vertices;
  std::vector<std::uint32_t> mesh_triangles, door_fixture;
  for (const Part& part : scene.parts) {
    // The surfaces of inner walls are those of the room.
    if (part.kind == PartKind::shell || part.footprint.empty() ||
        (part.fixture < scene.fixtures.size() && scene.fixtures[part.fixture].is_wall()))
      continue;
    if (part.kind == PartKind::mesh && part.triangle_count > 0 && part.triangle_count <= max_mesh_triangles) {
      std::map<std::uint32_t, std::uint32_t> known;
      for (std::uint32_t t = part.first_triangle; t < part.first_triangle + part.triangle_count; ++t)
        for (const std::uint32_t corner : scene.mesh.triangles[t]) {
          const auto next = static_cast<std::uint32_t>(mesh_vertices.size() / 3);
          const auto [found, is_new] = known.emplace(corner, next);
          if (is_new) append_point(mesh_vertices, scene.mesh.vertices[corner]);
          mesh_triangles.push_back(found->second);
        }
      continue;
    }
    look.push_back(colour_class_of(part.kind));
    if (part.kind == PartKind::door) door_fixture.push_back(part.fixture);
    corner_count.push_back(static_cast<std::uint8_t>(std::min<std::size_t>(part.footprint.size(), 255)));
    for (std::size_t k = 0; k < corner_count.back(); ++k)
      for (const double at : part.footprint[k]) corners.push_back(static_cast<float>(at));
    heights.push_back(static_cast<float>(part.bottom));
    heights.push_back(static_cast<float>(part.top));
  }
  page.add("part_look", look);
  page.add("part_corners", corner_count);
  page.add("part_outline", corners);
  page.add("part_height", heights);
  page.add("mesh_vertex", mesh_vertices);
  page.add("mesh_triangle", mesh_triangles);
  if (has_states) page.add("door_fixture", door_fixture);
}

// The surfaces of a room, as numbered by the script.
enum class Surface : std::uint8_t { floor, shell, inner_wall, glass };

// The triangles that are not of fixtures, for rooms that are not plain boxes. Those of the shell (walls,
// ceilings, the steps between them) face away from the room.
void add_room(PageData& page, const Scene& scene) {
  if (!scene.room || scene.room->is_plain_box()) return;
  std::vector<Surface> owner(scene.mesh.triangles.size(), Surface::shell);
  std::vector<bool> is_of_fixture(scene.mesh.triangles.size(), false);
  for (const FixtureOutline& fixture : scene.fixtures)
    for (std::uint32_t t = fixture.first_triangle; t < fixture.first_triangle + fixture.triangle_count; ++t) {
      is_of_fixture[t] = !fixture.is_wall();
      owner[t] = Surface::inner_wall;
    }
  std::vector<float> vertices;
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint8_t> surfaces;
  std::map<std::uint32_t, std::uint32_t> known;
  for (std::size_t t = 0; t < owner.size(); ++t) {
    if (is_of_fixture[t]) continue;
    const auto& corners = scene.mesh.triangles[t];
    const bool is_on_floor = std::all_of(corners.begin(), corners.end(), [&](std::uint32_t corner) {
      return scene.mesh.vertices[corner].z == 0;
    });
    const Surface surface = !is_opaque(scene.materials[scene.mesh.materials[t].value].material)
                                ? Surface::glass
                            : owner[t] == Surface::shell && is_on_floor ? Surface::floor
                                                                        : owner[t];
    surfaces.push_back(static_cast<std::uint8_t>(surface));
    for (const std::uint32_t corner : corners) {
      const auto [found, is_new] = known.emplace(corner, static_cast<std::uint32_t>(vertices.size() / 3));
      if (is_new) append_point(vertices, scene.mesh.vertices[corner]);
      triangles.push_back(found->second);
    }
  }
  page.add("room_vertex", vertices);
  page.add("room_triangle", triangles);
  page.add("room_surface", surfaces);
}

}  // namespace

nlohmann::ordered_json add_scene(PageData& page, const Scene& scene, bool has_states) {
  add_parts(page, scene, has_states);
  add_room(page, scene);
  const auto corner = [](const Vec3& v) { return nlohmann::ordered_json{v.x, v.y, v.z}; };
  return {{"lower", corner(scene.room ? scene.room->lower() : scene.lower)},
          {"upper", corner(scene.room ? scene.room->upper() : scene.upper)}};
}

}  // namespace shelfbeam
