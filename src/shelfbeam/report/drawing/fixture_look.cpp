#include "shelfbeam/report/drawing/fixture_look.hpp"

#include <algorithm>
#include <array>

namespace shelfbeam {

namespace {

constexpr std::uint32_t max_triangles = 200'000;  // per part, in a section

// The line in which a plane of constant height cuts a triangle, as path data.
std::string cut(const PlanView& view, const std::array<Vec3, 3>& corners, double z) {
  std::vector<Point> ends;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3 &a = corners[k], &b = corners[(k + 1) % corners.size()];
    if ((a.z > z) == (b.z > z)) continue;
    const double share = (z - a.z) / (b.z - a.z);
    ends.push_back(view.at(a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)));
  }
  if (ends.size() != 2) return {};
  return path_through(ends, true);
}

}  // namespace

bool has_plan(const FixtureOutline& fixture) {
  return fixture.footprint.size() > (fixture.form == FixtureForm::sheet ? 1U : 2U);
}

std::vector<std::uint32_t> fixtures_by_height(const Scene& scene) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t f = 0; f < scene.fixtures.size(); ++f)
    if (has_plan(scene.fixtures[f]) && !scene.fixtures[f].is_wall()) order.push_back(f);
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return scene.fixtures[a].height < scene.fixtures[b].height; });
  return order;
}

std::string mesh_section(const PlanView& view, const Scene& scene, std::uint32_t fixture) {
  std::string data;
  const FixtureOutline& outline = scene.fixtures[fixture];
  const bool is_upright_panel = outline.form == FixtureForm::sheet && outline.footprint.size() == 2;
  if (outline.form != FixtureForm::mesh && !is_upright_panel) return data;
  for (const Part& part : scene.parts) {
    if (part.fixture != fixture || part.triangle_count == 0 || part.triangle_count > max_triangles) continue;
    const bool is_cut = part.bottom < section_height && section_height < part.top;
    const double z = is_cut ? section_height : (part.bottom + part.top) / 2;
    for (std::uint32_t t = part.first_triangle; t < part.first_triangle + part.triangle_count; ++t) {
      const auto& [a, b, c] = scene.mesh.triangles[t];
      data += cut(view, {scene.mesh.vertices[a], scene.mesh.vertices[b], scene.mesh.vertices[c]}, z);
    }
  }
  return data;
}

}  // namespace shelfbeam
