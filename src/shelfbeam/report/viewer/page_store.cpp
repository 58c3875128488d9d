#include <algorithm>
#include <map>
#include <utility>

#include <nlohmann/json.hpp>

#include "shelfbeam/material/material.hpp"
#include "shelfbeam/report/viewer/page_data.hpp"
#include "shelfbeam/report/viewer/page_signals.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam {

namespace {

using Json = nlohmann::ordered_json;

// Per mesh; larger meshes are drawn as prisms. About 1 MB in the page.
constexpr std::uint32_t max_mesh_triangles = 30000;

void append(std::vector<float>& values, const Vec3& v) {
  for (int axis = 0; axis < 3; ++axis) values.push_back(static_cast<float>(v[axis]));
}

Json point(const Vec3& v) {
  return {v.x, v.y, v.z};
}

// The colour class of a part, as numbered by the script.
std::uint8_t colour_class_of(PartKind kind) {
  if (kind == PartKind::board || kind == PartKind::tub) return 1;
  return kind == PartKind::goods ? 2 : kind == PartKind::door ? 3 : 0;
}

// `has_states`: the doors are those of fixtures that a state may open.
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
          if (is_new) append(mesh_vertices, scene.mesh.vertices[corner]);
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
      if (is_new) append(vertices, scene.mesh.vertices[corner]);
      triangles.push_back(found->second);
    }
  }
  page.add("room_vertex", vertices);
  page.add("room_triangle", triangles);
  page.add("room_surface", surfaces);
}

// Labels of one type with equal requirements share one threshold in the page.
Json add_labels(PageData& page, const ReportData& data) {
  std::vector<float> position, normal;
  std::vector<std::uint16_t> kind, level(data.outcome.labels.size());
  std::map<std::pair<std::string, double>, std::uint16_t> known;
  Json kinds = Json::array(), ids = Json::array();
  for (const LabelRow& label : data.input.matrix.labels) {
    append(position, label.position);
    append(normal, label.normal);
    ids.push_back(label.id);
    const auto [found, is_new] =
        known.emplace(std::pair(label.type, label.requirement), static_cast<std::uint16_t>(known.size()));
    if (is_new) kinds.push_back({{"type", label.type}, {"requirement", label.requirement}});
    kind.push_back(found->second);
  }
  for (std::size_t k = 0; k < data.levels.size(); ++k)
    for (const std::uint32_t label : data.levels[k].labels) level[label] = static_cast<std::uint16_t>(k);
  page.add("label_position", position);
  page.add("label_normal", normal);
  page.add("label_kind", kind);
  page.add("label_level", level);
  return {{"ids", ids}, {"kinds", kinds}};
}

Json add_units(PageData& page, const ReportData& data) {
  std::vector<float> position, axis;
  Json ids = Json::array(), types = Json::array(), installed = Json::array();
  const auto& units = data.input.matrix.transceivers;
  for (std::uint32_t j = 0; j < units.size(); ++j) {
    append(position, units[j].position);
    append(axis, units[j].axis);
    ids.push_back(units[j].id);
    types.push_back(units[j].type);
    if (units[j].installed) installed.push_back(j);
  }
  page.add("unit_position", position);
  page.add("unit_axis", axis);
  Json selected = Json::array(), needed_by = Json::array();
  for (const UnitOutcome& unit : data.outcome.units) {
    selected.push_back(unit.column);
    needed_by.push_back(unit.needed_by);
  }
  return {{"ids", ids},
          {"types", types},
          {"installed", installed},
          {"mounts", shared_mounts(data.input.matrix)},
          {"selected", selected},
          {"neededBy", needed_by}};
}

// Verdicts by their number in Verdict, which the script knows; null without a certificate.
Json add_certificate(PageData& page, const ReportData& data) {
  const auto& certificate = data.input.plan.certificate;
  std::vector<std::uint8_t> verdicts;
  if (certificate)
    for (const LabelVerdict& label : certificate->labels)
      verdicts.push_back(static_cast<std::uint8_t>(label.verdict));
  page.add("label_verdict", verdicts);
  return certificate ? Json{{"confidence", rounded_down(certificate->confidence, 6)}} : Json();
}

Json levels_of(const ReportData& data) {
  Json levels = Json::array();
  for (const ShelfLevel& level : data.levels)
    levels.push_back(
        {{"from", fixed(level.low, 2)}, {"to", fixed(level.high, 2)}, {"labels", level.labels.size()}});
  return levels;
}

Json margins() {
  Json classes = Json::array();
  for (const MarginClass& margin : margin_classes)
    classes.push_back({{"from", margin.from}, {"name", margin.name()}});
  return classes;
}

// The people and objects of all states, one state after the other, as blocks with four corners each.
Json add_states(PageData& page, const ReportData& data) {
  std::map<std::string, std::size_t> known;
  const auto& fixtures = data.input.scene.fixtures;
  for (std::size_t k = 0; k < fixtures.size(); ++k) known.emplace(fixtures[k].id, k);
  std::vector<float> outlines, heights;
  Json states = Json::array();
  for (const ShopState& state : data.input.states) {
    for (const ShopState::Block& block : state.blocks) {
      for (const Vec2& corner : block.footprint)
        for (const double at : corner) outlines.push_back(static_cast<float>(at));
      heights.push_back(static_cast<float>(block.bottom));
      heights.push_back(static_cast<float>(block.top));
    }
    Json open = Json::array();
    for (const std::string& id : state.open_doors) open.push_back(known.at(id));
    states.push_back({{"number", state.verdicts.number},
                      {"blocks", state.blocks.size()},
                      {"open", open},
                      {"missed", state.verdicts.missed}});
  }
  page.add("block_outline", outlines);
  page.add("block_height", heights);
  return states;
}

// Fixtures and zones with the places of their names.
Json named_places(const Scene& scene) {
  Json names = Json::array();
  const auto add = [&](const std::string& id, const Polygon& plan, const auto& height_at) {
    Vec2 middle{};
    for (const auto& [x, y] : plan) {
      middle[0] += x / static_cast<double>(plan.size());
      middle[1] += y / static_cast<double>(plan.size());
    }
    names.push_back({{"id", id}, {"at", point({middle[0], middle[1], height_at(middle)})}});
  };
  for (const FixtureOutline& fixture : scene.fixtures)
    add(fixture.id, fixture.footprint, [&](const Vec2&) { return fixture.height; });
  if (scene.room)
    for (const CeilingZone& zone : scene.room->zones)
      add(zone.id, zone.polygon, [&](const Vec2& middle) { return zone.height.at(middle); });
  return names;
}

}  // namespace

std::string pack_store(const ReportData& data, const SignalScale& scale) {
  const Scene& scene = data.input.scene;
  const PlacementProblem& problem = data.input.plan.placement.problem;
  PageData page;
  const bool has_states = !data.input.states.empty();
  add_parts(page, scene, has_states);
  add_room(page, scene);
  Json about;
  about["lower"] = point(scene.room ? scene.room->lower() : scene.lower);
  about["upper"] = point(scene.room ? scene.room->upper() : scene.upper);
  about["cooperative"] = problem.model == CommunicationModel::cooperative;
  about["redundant"] = problem.redundant;
  about["tolerance"] = met_tolerance;
  about["unit"] = {{"factor", data.unit.factor}, {"name", data.unit.name}};
  about["margins"] = margins();
  about["signals"] = scale.edges;
  about["levels"] = levels_of(data);
  about["fixtures"] = named_places(scene);
  about["labels"] = add_labels(page, data);
  about["units"] = add_units(page, data);
  about["certificate"] = add_certificate(page, data);
  if (has_states) about["states"] = add_states(page, data);
  return page.base64(about.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace shelfbeam
