#include <array>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/csv.hpp"
#include "shelfbeam/report/data/report.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/mounting/cad_text.hpp"
#include "shelfbeam/report/mounting/mounting_sheet.hpp"
#include "shelfbeam/report/place/place_text.hpp"
#include "shelfbeam/report/text/words.hpp"
#include "shelfbeam/scene/wall_section.hpp"

namespace shelfbeam {

namespace {

constexpr const char* units_layer = "SHELFBEAM_UNITS";
constexpr const char* installed_layer = "SHELFBEAM_INSTALLED";  // units that need no mounting
constexpr const char* store_layer = "SHELFBEAM_STORE";
constexpr const char* note_layer = "SHELFBEAM_NOTE";
constexpr const char* block = "SHELFBEAM_UNIT";
constexpr double radius = 0.15, text_height = 0.2, line_height = 0.3;  // m
constexpr double cut_height = 1.2;                                     // of walls, m

/// A drawing in the exchange format of AutoCAD release 12, which every reader knows: pairs of a group code
/// and a value, a line each.
class Dxf {
 public:
  template <class Value>
  Dxf& put(int code, const Value& value) {
    text_ += fmt::format("{}\n{}\n", code, value);
    return *this;
  }
  Dxf& put(int code, double value) {
    text_ += fmt::format("{}\n{:.6f}\n", code, value);
    return *this;
  }
  Dxf& at(double x, double y, double z = 0, int corner = 0) {
    return put(10 + corner, x).put(20 + corner, y).put(30 + corner, z);
  }
  Dxf& begin(const char* name) { return put(0, "SECTION").put(2, name); }
  Dxf& end() { return put(0, "ENDSEC"); }
  const std::string& text() { return put(0, "EOF").text_; }

 private:
  std::string text_;
};

void add_layers(Dxf& dxf) {
  constexpr int black = 7, grey = 8;
  dxf.begin("TABLES").put(0, "TABLE").put(2, "LAYER").put(70, 4);
  for (const auto& [name, colour] : {std::pair(units_layer, black), std::pair(installed_layer, black),
                                     std::pair(store_layer, grey), std::pair(note_layer, grey)})
    dxf.put(0, "LAYER").put(2, name).put(70, 0).put(62, colour).put(6, "CONTINUOUS");
  dxf.put(0, "ENDTAB").end();
}

struct Attribute {
  const char* tag;
  std::string_view prompt;
  std::string value;
  bool is_hidden;
};

std::vector<Attribute> attributes_of(const Words& words, const MountedUnit& unit) {
  return {{"NUMBER", words("mounting.prompt.number"), fmt::format("{}", unit.number), false},
          {"HEIGHT", words("mounting.prompt.height"), words.say("mounting.cm", height_cm(unit)), false},
          {"ID", words("mounting.prompt.id"), cad_text(unit.id), true},
          {"TYPE", words("mounting.prompt.type"), cad_text(unit.type), true},
          {"TILT", words("mounting.prompt.tilt"), fmt::format("{:.1f}", unit.tilt_deg), true},
          {"TOWARDS", words("mounting.prompt.towards"), fmt::format("{:.1f}", unit.towards_deg), true},
          {"PLACE", words("mounting.prompt.place"), cad_text(place_text(words, unit.place)), true},
          {"ORDER", words("mounting.prompt.order"), cad_text(unit.order_number), true}};
}

void add_block(const Words& words, Dxf& dxf) {
  dxf.begin("BLOCKS");
  dxf.put(0, "BLOCK").put(8, units_layer).put(2, block).put(70, 2).at(0, 0).put(3, block);
  dxf.put(0, "CIRCLE").put(8, units_layer).at(0, 0).put(40, radius);
  dxf.put(0, "LINE").put(8, units_layer).at(-radius, 0).at(radius, 0, 0, 1);
  dxf.put(0, "LINE").put(8, units_layer).at(0, -radius).at(0, radius, 0, 1);
  double y = radius;
  for (const Attribute& attribute : attributes_of(words, {})) {
    dxf.put(0, "ATTDEF").put(8, units_layer).at(1.2 * radius, y).put(40, text_height).put(1, "");
    dxf.put(3, cad_text(attribute.prompt)).put(2, attribute.tag).put(70, attribute.is_hidden ? 1 : 0);
    y -= line_height;
  }
  dxf.put(0, "ENDBLK").put(8, units_layer).end();
}

void add_note(const Words& words, Dxf& dxf, double x, double y, std::string_view key) {
  dxf.put(0, "TEXT").put(8, note_layer).at(x, y).put(40, text_height).put(1, cad_text(words(key)));
}

void add_line(Dxf& dxf, const Vec2& from, const Vec2& to) {
  dxf.put(0, "LINE").put(8, store_layer).at(from[0], from[1]).at(to[0], to[1], 0, 1);
}

void add_outline(Dxf& dxf, std::span<const Vec2> corners) {
  for (std::size_t k = 0; k < corners.size(); ++k)
    add_line(dxf, corners[k], corners[(k + 1) % corners.size()]);
}

void add_unit(const Words& words, Dxf& dxf, const MountedUnit& unit) {
  const Vec3& p = unit.position;
  const char* const layer = unit.installed ? installed_layer : units_layer;
  dxf.put(0, "INSERT").put(8, layer).put(66, 1).put(2, block).at(p.x, p.y, p.z);
  double y = p.y + radius;
  for (const Attribute& attribute : attributes_of(words, unit)) {
    dxf.put(0, "ATTRIB").put(8, layer).at(p.x + 1.2 * radius, y, p.z).put(40, text_height);
    dxf.put(1, attribute.value).put(2, attribute.tag).put(70, attribute.is_hidden ? 1 : 0);
    y -= line_height;
  }
  dxf.put(0, "SEQEND").put(8, layer);
}

}  // namespace

std::string mounting_csv(const ReportInput& input) {
  const Words words = words_of(input.scene);
  const auto text = [&](std::string_view field) { return csv_field(field, input.safe_csv); };
  std::string csv =
      "number,id,type,installed,distance_1_cm,from_1,distance_2_cm,from_2,height_cm,tilt_deg,towards_deg,"
      "roll_deg,pinned,place,tolerance_cm,order_number\n";
  for (const MountedUnit& unit : mounting_sheet(input)) {
    const auto& [first, second] = unit.references;
    csv += fmt::format(
        "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", unit.number, text(unit.id), text(unit.type),
        unit.installed ? 1 : 0, centimetres(first.distance), text(name_of(words, first)),
        centimetres(second.distance), text(name_of(words, second)), height_cm(unit),
        csv_number(std::round(10 * unit.tilt_deg) / 10), csv_number(std::round(10 * unit.towards_deg) / 10),
        csv_number(unit.roll_deg), unit.pinned ? 1 : 0, text(place_text(words, unit.place)),
        unit.tolerance > 0 ? fmt::format("{}", centimetres(unit.tolerance)) : std::string(),
        text(unit.order_number));
  }
  return csv;
}

std::string mounting_dxf(const ReportInput& input) {
  const Words words = words_of(input.scene);
  const Scene& scene = input.scene;
  Dxf dxf;
  const Vec3 corner = scene.lower - Vec3{0, 2 * line_height, 0};
  dxf.begin("HEADER").put(9, "$ACADVER").put(1, "AC1009").put(9, "$EXTMIN").at(corner.x, corner.y, corner.z);
  dxf.put(9, "$EXTMAX").at(scene.upper.x, scene.upper.y, scene.upper.z).end();
  add_layers(dxf);
  add_block(words, dxf);
  dxf.begin("ENTITIES");
  // Release 12 has no variable for the unit of length, so a text below the shop states it.
  add_note(words, dxf, corner.x, corner.y, "mounting.drawing_unit");
  if (!input.plan.is_verified())
    add_note(words, dxf, corner.x, corner.y + line_height, "certificate.lacking");
  if (scene.room) {
    for (std::size_t k = 0; k < scene.room->outline.size(); ++k)
      for (const auto& [from, to] : outer_wall_lines(*scene.room, k, cut_height)) add_line(dxf, from, to);
    for (const Polygon& hole : scene.room->holes) add_outline(dxf, hole);
    for (const CeilingZone& zone : scene.room->zones) add_outline(dxf, zone.polygon);
  }
  for (const FixtureOutline& fixture : scene.fixtures)
    if (!fixture.is_wall()) add_outline(dxf, fixture.footprint);
  if (scene.room)
    for (const WallSection& wall : wall_sections(*scene.room, cut_height))
      for (const auto* loops : {&wall.cut, &wall.below})
        for (const Polygon& loop : *loops) add_outline(dxf, loop);
  for (const MountedUnit& unit : mounting_sheet(input)) add_unit(words, dxf, unit);
  dxf.end();
  return dxf.text();
}

}  // namespace shelfbeam
