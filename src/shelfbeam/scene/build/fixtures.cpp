#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>

#include <fmt/format.h>

#include "shelfbeam/scene/build/fixture_geometry.hpp"

namespace shelfbeam {

namespace {

// Dimensions of real shelving, m.
constexpr double panel_thickness = 0.04;
constexpr double board_thickness = 0.04;
constexpr double kick_height = 0.12;
constexpr double kick_recess = 0.04;
constexpr double facing_width = 0.3;    // of one product
constexpr double facing_gap = 0.01;     // between neighbours
constexpr double goods_setback = 0.03;  // behind the board edge
constexpr double headroom = 0.9;        // full goods take this share of the height between boards
constexpr double door_distance = 0.05;  // before the board edges
constexpr double casing_thickness = 0.02;
constexpr double door_frame = 0.01;  // by which a casing reaches beyond its doors
constexpr double tub_wall = 0.06;
constexpr double label_below_rim = 0.05;

std::uint32_t begin_fixture(Scene& scene, const std::string& id, std::string_view type, const Vec2& at,
                            double length, double depth, double height, double rotation_deg) {
  scene.fixtures.push_back(
      {id, std::string(type), rectangle_footprint(at, length, depth, rotation_deg), height, rotation_deg});
  return static_cast<std::uint32_t>(scene.fixtures.size() - 1);
}

std::uint32_t begin_fixture(Scene& scene, const Shelving& s, std::string_view type) {
  return begin_fixture(scene, s.id, type, s.at, s.length, s.depth, s.height, s.rotation_deg);
}

// A row of goods between x = low.x and high.x, as deep as the box, standing on low.z below high.z.
void add_goods_row(FixtureBuilder& builder, const Vec3& low, const Vec3& high, double stocking,
                   MaterialId material, const std::string& key) {
  const double clearance = high.z - low.z;
  if (clearance < 0.05 || high.y - low.y < 0.02) return;
  const auto count = static_cast<std::size_t>(std::max(1L, std::lround((high.x - low.x) / facing_width)));
  const double pitch = (high.x - low.x) / static_cast<double>(count);
  const std::vector<double> fill = stock(count, stocking, key);
  for (std::size_t k = 0; k < count; ++k) {
    if (fill[k] <= 0) continue;
    const double x = low.x + static_cast<double>(k) * pitch;
    builder.add_box(PartKind::goods, {x + facing_gap / 2, low.y, low.z},
                    {x + pitch - facing_gap / 2, high.y, low.z + headroom * clearance * fill[k]}, material);
  }
}

bool has_face(const Gondola& g, Face face) {
  return std::find(g.faces.begin(), g.faces.end(), face) != g.faces.end();
}

// What stands around a gondola with doors, outside its length and depth but for the top, which ends at its
// height. The panel reaches from `panel` to `panel_end` along the depth, the kick plate up to `deck`.
void add_casing(Scene& scene, FixtureBuilder& builder, const Gondola& g, double panel, double panel_end,
                double deck) {
  constexpr double reach = door_distance + door_frame;
  const double low_y = has_face(g, Face::front) ? -reach : 0;
  const double high_y = has_face(g, Face::back) ? g.depth + reach : g.depth;
  const double top = g.height - casing_thickness;
  const auto add_wall = [&](double x) {
    builder.add_box(PartKind::casing, {x, low_y, 0}, {x + casing_thickness, high_y, g.height}, g.material);
  };
  add_wall(-casing_thickness);
  add_wall(g.length);
  const auto add_front = [&](double door, double top_low, double top_high) {
    builder.add_box(PartKind::casing, {0, top_low, top}, {g.length, top_high, g.height}, g.material);
    builder.add_door({0, door, deck}, {g.length, door, top}, *g.doors);
  };
  if (has_face(g, Face::front)) add_front(-door_distance, low_y, panel);
  if (has_face(g, Face::back)) add_front(g.depth + door_distance, panel_end, high_y);
  scene.fixtures.back().footprint =
      builder.footprint({-casing_thickness, low_y, 0}, {g.length + casing_thickness, high_y, 0});
}

}  // namespace

void add_fixture(Scene& scene, const Gondola& g) {
  const auto index = begin_fixture(scene, g, "gondola");
  FixtureBuilder builder(scene, index, {g.at[0], g.at[1], 0}, g.rotation_deg);

  const bool front = has_face(g, Face::front), back = has_face(g, Face::back);
  const double panel = front && back ? (g.depth - panel_thickness) / 2
                       : front       ? g.depth - panel_thickness
                                     : 0;
  builder.add_box(PartKind::panel, {0, panel, 0}, {g.length, panel + panel_thickness, g.height}, g.material);
  const double lowest = g.shelves.empty() ? g.height : g.shelves.front() - board_thickness / 2;
  const double deck = std::min(kick_height, lowest);

  const auto add_side = [&](Face face, double low_y, double high_y) {
    const bool faces_low = face == Face::front;
    // A casing stands on its kick plate; no light comes in from below.
    const double recess = g.doors ? -door_distance - door_frame : std::min(kick_recess, (high_y - low_y) / 2);
    const double kick_low = faces_low ? low_y + recess : low_y;
    const double kick_high = faces_low ? high_y : high_y - recess;
    const double goods_low = faces_low ? low_y + goods_setback : low_y + facing_gap;
    const double goods_high = faces_low ? high_y - facing_gap : high_y - goods_setback;
    builder.add_box(g.doors ? PartKind::casing : PartKind::kick_plate, {0, kick_low, 0},
                    {g.length, kick_high, deck}, g.material);
    for (std::size_t level = 0; level <= g.shelves.size(); ++level) {
      const double floor = level == 0 ? deck : g.shelves[level - 1] + board_thickness / 2;
      const double ceiling = level < g.shelves.size() ? g.shelves[level] - board_thickness / 2 : g.height;
      if (level > 0)
        builder.add_box(PartKind::board, {0, low_y, floor - board_thickness}, {g.length, high_y, floor},
                        g.material);
      add_goods_row(builder, {0, goods_low, floor}, {g.length, goods_high, ceiling}, g.stocking, g.goods,
                    fmt::format("{}-{}-{}", g.id, face_name(face), level));
    }
  };
  if (front) add_side(Face::front, 0, panel);
  if (back) add_side(Face::back, panel + panel_thickness, g.depth);
  if (g.doors) add_casing(scene, builder, g, panel, panel + panel_thickness, deck);

  if (!g.labels) return;
  for (const Face face : g.labels->faces)
    for (std::size_t level = 0; level < g.shelves.size(); ++level)
      builder.add_label_row(*g.labels, face, g.length, g.depth, g.shelves[level],
                            static_cast<int>(level) + 1);
}

void add_fixture(Scene& scene, const Freezer& f) {
  const auto index = begin_fixture(scene, f, "freezer");
  FixtureBuilder builder(scene, index, {f.at[0], f.at[1], 0}, f.rotation_deg);

  const double base = std::min(kick_height, f.height / 2), l = f.length, d = f.depth;
  builder.add_box(PartKind::kick_plate, {kick_recess, kick_recess, 0},
                  {l - kick_recess, d - kick_recess, base}, f.material);
  builder.add_box(PartKind::tub, {0, 0, base}, {l, tub_wall, f.height}, f.material);
  builder.add_box(PartKind::tub, {0, d - tub_wall, base}, {l, d, f.height}, f.material);
  builder.add_box(PartKind::tub, {0, tub_wall, base}, {tub_wall, d - tub_wall, f.height}, f.material);
  builder.add_box(PartKind::tub, {l - tub_wall, tub_wall, base}, {l, d - tub_wall, f.height}, f.material);
  const double bottom = base + tub_wall;
  builder.add_box(PartKind::tub, {tub_wall, tub_wall, base}, {l - tub_wall, d - tub_wall, bottom},
                  f.material);
  const double middle = d / 2;
  for (const auto& [low, high, side] :
       {std::tuple{tub_wall, middle, "front"}, {middle, d - tub_wall, "back"}})
    add_goods_row(builder, {tub_wall, low + facing_gap, bottom}, {l - tub_wall, high - facing_gap, f.height},
                  f.stocking, f.goods, fmt::format("{}-{}", f.id, side));
  if (f.doors)
    builder.add_door({tub_wall, tub_wall, f.height}, {l - tub_wall, d - tub_wall, f.height}, *f.doors);

  if (!f.labels) return;
  for (const Face face : f.labels->faces)
    builder.add_label_row(*f.labels, face, l, d, f.height - label_below_rim, 1);
}

void add_fixture(Scene& scene, const Box& b) {
  const Vec3 size = b.max - b.min;
  const auto index = begin_fixture(scene, b.id, "box", {b.min.x, b.min.y}, size.x, size.y, b.max.z, 0);
  FixtureBuilder(scene, index, b.min, 0).add_box(PartKind::solid, {}, size, b.material);
}

void add_fixture(Scene& scene, const MeshFixture& m) {
  const auto index = begin_fixture(scene, m.id, "mesh", {m.at.x, m.at.y}, 0, 0, 0, m.rotation_deg);
  FixtureBuilder builder(scene, index, m.at, m.rotation_deg);
  std::vector<Vec2> plan;
  for (const MeshPiece& piece : m.pieces) {
    builder.add_mesh(piece, m.scale);
    const Part& part = scene.parts.back();
    plan.insert(plan.end(), part.footprint.begin(), part.footprint.end());
    scene.fixtures[index].height = std::max(scene.fixtures[index].height, part.top);
  }
  scene.fixtures[index].footprint = convex_hull(std::move(plan));
}

}  // namespace shelfbeam
