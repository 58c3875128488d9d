#include "shelfbeam/scene/store/device_fields.hpp"

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/fields/describe_choice.hpp"
#include "shelfbeam/base/json.hpp"
#include "shelfbeam/material/material_fields.hpp"
#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/scene/field_values.hpp"
#include "shelfbeam/scene/read_values.hpp"

namespace shelfbeam {

namespace {

using Json = nlohmann::ordered_json;

void describe_factor(Fields& f, std::string_view key, double& factor, std::string_view says) {
  f.scalar(key, Scalar::number, factor,
           {.says = says, .least = 1e-3, .most = 1e3, .is_optional = true, .is_written = factor != 1});
}

void describe_type(Fields& f, TransceiverTypeId& type) {
  f.reference("type", NameList::transceiver_type, type.value, {.says = "transceiver type"});
}

void describe_axis(Fields& f, Vec3& axis, double& roll_deg) {
  describe_direction(
      f, "axis", axis,
      {.says = "direction from which emission angles are measured; the default is straight down",
       .is_optional = true,
       .otherwise = "`[0, 0, -1]`"});
  f.scalar("roll_deg", Scalar::degrees, roll_deg,
           {.says = "right-handed rotation about the axis", .is_optional = true});
}

void describe_axes(Fields& f, MountedType& unit) {
  const CustomValue directions{[&](const JsonCursor& json) {
                                 std::vector<Vec3> axes;
                                 for (const JsonCursor& axis : json.elements())
                                   axes.push_back(read_direction(axis));
                                 if (axes.empty())
                                   json.fail("is empty", "give at least one direction, or remove the key");
                                 unit.axes = std::move(axes);
                               },
                               {},
                               R"({"$ref": "#/$defs/axes"})"};
  f.custom(
      "axes", directions,
      {.says = "directions; with several, each point has one candidate for each of them, of which at most "
               "one is chosen",
       .is_optional = true,
       .otherwise = "`[[0, 0, -1]]`"});
  f.scalar("roll_deg", Scalar::degrees, unit.roll_deg,
           {.says = "right-handed rotation about the axis", .is_optional = true});
}

void describe_spacing(Fields& f, double& spacing, std::string_view says) {
  f.length(
      "spacing", spacing,
      {.says = says,
       .usual_least = 0.25,
       .usual_most = 8,
       .usual = "0.5 to 3 m are typical; a narrow spacing makes very many candidates, and a wide one leaves "
                "few to choose from"});
}

}  // namespace

void describe(NamedMaterial& named, Fields& f, double wavelength_nm) {
  ReflectanceKeys keys{wavelength_nm, named.reflectance_range};
  describe(named.material, f, keys);
  named.reflectance_range = keys.range;
}

void describe(Label& label, Fields& f) {
  f.text("id", label.id, {.says = "id of the label", .is_name = true});
  describe_note(f, "description", label.description, "description of its article, for reports");
  describe_point(f, "position", label.position, {.says = "`[x, y, z]`"});
  describe_direction(f, "normal", label.normal, {.says = "direction that the label faces"});
  f.label_type("type", label.type, {.says = "label type"});
  describe_factor(f, "relative_sensitivity", label.relative_sensitivity,
                  "sensitivity, relative to the label's type ([states](variation.md#states))");
  f.boolean(
      "receiver", label.is_receiver,
      {.says = "whether it is a receiver in the air, as those of "
               "[measuring planes](#measuring-planes): mounted on nothing, and at no place of a fixture",
       .is_optional = true,
       .is_written = label.is_receiver});
}

void describe(Transceiver& unit, Fields& f) {
  f.text("id", unit.id, {.says = "id of the unit", .is_name = true});
  describe_point(f, "position", unit.position, {.says = "`[x, y, z]`"});
  describe_axis(f, unit.axis, unit.roll_deg);
  describe_type(f, unit.type);
  describe_factor(f, "relative_power", unit.relative_power,
                  "power, relative to the unit's type ([states](variation.md#states))");
}

void describe(TransceiverGrid& grid, Fields& f) {
  describe_type(f, grid.type);
  f.plan_point("min", grid.min, {.says = "`[x, y]` of the first candidate"});
  f.plan_point("max", grid.max, {.says = "`[x, y]` of the last candidate"});
  describe_spacing(
      f, grid.spacing,
      "distance between neighbours, adjusted slightly where it does not divide the extent, so that "
      "both ends have candidates");
  f.scalar("z", Scalar::coordinate, grid.z, {.says = "height"});
  describe_axis(f, grid.axis, grid.roll_deg);
}

void describe(MountArea& mount, Fields& f) {
  describe_type(f, mount.unit.type);
  describe_plan_area(
      f, mount.area,
      "`\"room\"` for the whole room, `\"room without zones\"` for its part outside all zones, the id of a "
      "[zone](room.md#ceilings), or a polygon: corners `[x, y]` in order");
  describe_spacing(f, mount.spacing,
                   "distance between neighbours, adjusted slightly where it does not divide the bounds");
  f.either(
      {"z"}, mount.z.has_value(),
      [&](Fields& by_height) {
        double z = 0;
        if (by_height.scalar("z", Scalar::coordinate, z,
                             {.says = "height", .otherwise = "*required*, or `below_ceiling`"}))
          mount.z = z;
      },
      [&](Fields& by_ceiling) {
        by_ceiling.scalar("below_ceiling", Scalar::distance, mount.below_ceiling,
                          {.says = "distance below the ceiling, which may have several heights",
                           .otherwise = "*required*, or `z`"});
      });
  describe_axes(f, mount.unit);
}

void describe(MountRail& rail, Fields& f) {
  describe_type(f, rail.unit.type);
  f.text("id", rail.id,
         {.says = "name of the rail; its candidates are `<id>-1`, `<id>-2` and so on", .is_name = true});
  const CustomValue line{[&](const JsonCursor& json) {
                           for (const JsonCursor& point : json.elements()) {
                             rail.points.push_back(read_point(point));
                             const std::size_t count = rail.points.size();
                             if (count > 1 && !(length(rail.points[count - 1] - rail.points[count - 2]) > 0))
                               point.fail("is the point before", "remove it");
                           }
                           if (rail.points.size() < 2)
                             json.fail("has fewer than two points", "give the line of the rail");
                         },
                         {},
                         R"({"type": "array", "items": {"$ref": "#/$defs/point"}, "minItems": 2})"};
  f.custom("points", line, {.says = "`[x, y, z]` of the corners of the line", .unit = "m"});
  describe_spacing(f, rail.spacing,
                   "distance along the rail, adjusted slightly so that both ends have candidates");
  describe_axes(f, rail.unit);
}

void describe(MountFaces& mount, Fields& f) {
  describe_type(f, mount.type);
  f.text("id", mount.id,
         {.says = "beginning of the ids; a fixture or wall with several members in `on` needs it, because no "
                  "rail and no other member may have the same id",
          .is_name = true,
          .is_optional = true,
          .otherwise = "`<fixture>`, `<inner wall>` or `wall-<wall>`; with a `face`, `<fixture>-<face>`"});
  const std::string_view one_of_them = "*required*, one of the three";
  f.one_of({"fixture", "wall", "inner_wall"});
  std::string name;
  std::int64_t wall = 0;
  if (f.text("fixture", name, {.says = "id of a fixture", .is_optional = true, .otherwise = one_of_them}))
    mount.on = name;
  if (f.integer("wall", wall,
                {.says = "number of a wall of the room as for [`wall_materials`](room.md)",
                 .least = 0,
                 .most = 1e9,
                 .is_optional = true,
                 .otherwise = one_of_them}))
    mount.on = static_cast<std::size_t>(wall);
  if (f.text("inner_wall", name,
             {.says = "id of an inner wall", .is_optional = true, .otherwise = one_of_them}))
    mount.on = name;
  auto face = mount.face.value_or(Compass::north);
  if (describe_choice(
          f, "face", face, std::span<const Named<Compass>>(names_of<Compass>),
          {.says = "with `fixture` or `inner_wall`: only [the face that looks there](#faces-by-the-compass)",
           .is_optional = true,
           .otherwise = "all around"}))
    mount.face = face;
  f.scalar("z", Scalar::coordinate, mount.z, {.says = "height"});
  // Small columns may have a narrow spacing.
  f.length("spacing", mount.spacing, {.says = "distance between neighbours, adjusted slightly"});
  const CustomValue tilts{[&](const JsonCursor& json) {
                            constexpr double upright = 90;
                            std::vector<double> all;
                            if (json.is_array())
                              for (const JsonCursor& tilt : json.elements())
                                all.push_back(tilt.number(-upright, upright));
                            else
                              all.push_back(json.number(-upright, upright));
                            if (all.empty())
                              json.fail("is empty", "give at least one tilt, or remove the key");
                            mount.tilts_deg = std::move(all);
                          },
                          {},
                          R"({"oneOf": [{"$ref": "#/$defs/tilt_deg"},
                              {"type": "array", "items": {"$ref": "#/$defs/tilt_deg"}, "minItems": 1}]})"};
  f.custom("tilt_deg", tilts,
           {.says = "downward tilt from horizontal, -90 to 90; with a list of several, each point has one "
                    "candidate for each of them, of which at most one is chosen",
            .unit = "degrees",
            .is_optional = true,
            .otherwise = "0"});
  f.scalar("offset", Scalar::distance, mount.offset,
           {.says = "distance from the surface; a distance below 0.0001 m is increased to it",
            .is_optional = true});
  f.scalar("roll_deg", Scalar::degrees, mount.roll_deg,
           {.says = "right-handed rotation about the axis", .is_optional = true});
}

void describe(KeepOut& area, Fields& f) {
  f.either(
      {"polygon"}, !area.polygon.empty(),
      [&](Fields& outline) {
        if (outline.polygon(
                "polygon", area.polygon,
                {.says = "corners `[x, y]` in order", .unit = "m", .otherwise = "*required*, or `min`"})) {
          const auto [low, high] = bounds_of(area.polygon);
          area.min = low;
          area.max = high;
        }
      },
      [&](Fields& rectangle) {
        rectangle.plan_point(
            "min", area.min,
            {.says = "`[x, y]`: corner of a rectangle", .otherwise = "*required*, or `polygon`"});
        rectangle.plan_point("max", area.max,
                             {.says = "`[x, y]`: the opposite corner, not below `min`",
                              .otherwise = "*required*, or `polygon`"});
      });
  std::array<double, 2> heights{};
  if (f.array("z", Scalar::coordinate, heights,
              {.says = "`[low, high]`: the heights without candidates",
               .is_optional = true,
               .otherwise = "all heights"})) {
    area.low = heights[0];
    area.high = heights[1];
  }
}

}  // namespace shelfbeam
