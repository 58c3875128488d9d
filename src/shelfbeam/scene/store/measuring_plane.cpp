#include "shelfbeam/scene/store/measuring_plane.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/field_reader.hpp"
#include "shelfbeam/scene/field_values.hpp"
#include "shelfbeam/scene/read_values.hpp"
#include "shelfbeam/scene/store/device_fields.hpp"
#include "shelfbeam/scene/store/store_parts.hpp"

namespace shelfbeam {

namespace {

constexpr std::size_t max_receivers = 1'000'000;  // of a plane

void read_axes(const JsonCursor& json, std::array<Vec3, 2>& axes) {
  constexpr double rounding = 1e-4;  // directions may have few digits
  const std::vector<JsonCursor> directions = json.elements();
  if (directions.size() != 2)
    json.fail(fmt::format("has {} directions", directions.size()),
              "give that of the columns and that of the rows");
  axes = {read_direction(directions[0]), read_direction(directions[1])};
  if (std::abs(dot(axes[0], axes[1])) > rounding)
    json.fail("are not perpendicular to each other", "correct one of the two");
}

void describe_counts(Fields& f, std::optional<std::array<std::size_t, 2>>& counts) {
  const CustomValue value{[&](const JsonCursor& json) {
                            json.numbers(2);
                            std::array<std::size_t, 2> cells{};
                            for (std::size_t k = 0; k < 2; ++k)
                              cells[k] = static_cast<std::size_t>(
                                  json.element(k).integer(1, static_cast<std::int64_t>(max_receivers)));
                            counts = cells;
                          },
                          {},
                          R"({"type": "array", "items": {"type": "integer", "minimum": 1, "maximum": 1000000},
          "minItems": 2, "maxItems": 2})"};
  f.custom("counts", value,
           {.says = "`[columns, rows]`: the numbers of receivers",
            .is_optional = true,
            .otherwise = "*required*, or `spacing`"});
}

}  // namespace

std::array<std::size_t, 2> MeasuringPlane::cells() const {
  if (counts) return *counts;
  const auto along = [&](double extent) {
    return static_cast<std::size_t>(std::max(1L, std::lround(extent / spacing)));
  };
  return {along(size[0]), along(size[1])};
}

std::array<Vec3, 4> MeasuringPlane::corners() const {
  const Vec3 across = axes[0] * size[0], up = axes[1] * size[1];
  return {origin, origin + across, origin + across + up, origin + up};
}

void MeasuringPlane::each_label(const std::function<void(Label)>& use) const {
  const auto [columns, rows] = cells();
  const Vec3 facing = normal.value_or(normalized(cross(axes[0], axes[1])));
  const auto middle = [](std::size_t k, std::size_t count) {
    return (static_cast<double>(k) + 0.5) / static_cast<double>(count);
  };
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column) {
      Label label;
      label.id = fmt::format("{}-{}-{}", id, row + 1, column + 1);
      label.position =
          origin + axes[0] * (size[0] * middle(column, columns)) + axes[1] * (size[1] * middle(row, rows));
      label.normal = facing;
      label.type = type;
      label.is_receiver = true;
      use(std::move(label));
    }
}

void describe(MeasuringPlane& plane, Fields& f) {
  f.text("id", plane.id,
         {.says = "name of the plane; its labels are `<id>-<row>-<column>`, both counted from 1",
          .is_name = true});
  f.label_type("type", plane.type, {.says = "label type of the receivers"});
  describe_point(f, "origin", plane.origin,
                 {.says = "`[x, y, z]` of the corner where row 1 and column 1 meet"});
  const CustomValue axes{
      [&](const JsonCursor& json) { read_axes(json, plane.axes); },
      {},
      R"({"type": "array", "items": {"$ref": "#/$defs/direction"}, "minItems": 2, "maxItems": 2})"};
  f.custom("axes", axes,
           {.says = "two perpendicular directions: in which the columns follow one another, and the rows"});
  f.array("size", Scalar::length, plane.size, {.says = "extents of the rectangle along the two axes"});
  Vec3 normal = plane.normal.value_or(Vec3{0, 0, 1});
  if (describe_direction(f, "normal", normal,
                         {.says = "direction that the receivers face",
                          .is_optional = true,
                          .otherwise = "perpendicular to the plane: first axis x second axis"}))
    plane.normal = normal;
  f.one_of({"spacing", "counts"});
  f.length("spacing", plane.spacing,
           {.says = "distance between neighbours, adjusted slightly where it does not divide the extents",
            .is_optional = true,
            .otherwise = "*required*, or `counts`"});
  describe_counts(f, plane.counts);
}

void read_measuring_planes(const JsonCursor& section, const StoreNames& names, Store& store,
                           Problems& problems) {
  read_list(section, names, problems, store.measuring_planes,
            [](FieldReader& reader, const MeasuringPlane& plane) {
              reader.rule({"size", "spacing", "counts"}, [&] {
                const auto [columns, rows] = plane.cells();
                if (columns > max_receivers / rows)
                  reader.json()[plane.counts ? "counts" : "spacing"].fail(
                      fmt::format("produces more than {} receivers", grouped(max_receivers)),
                      plane.counts ? "use fewer" : "use a wider spacing");
              });
            });
}

}  // namespace shelfbeam
