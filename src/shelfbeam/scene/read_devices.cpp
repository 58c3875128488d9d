#include <cmath>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/scene/device_csv.hpp"
#include "shelfbeam/scene/store_parts.hpp"

namespace shelfbeam {

namespace {

Vec2 read_corner(const JsonCursor& cursor) {
  const auto v = cursor.numbers(2);
  return {v[0], v[1]};
}

void expect_extent(const JsonCursor& cursor, const Vec2& low, const Vec2& high) {
  if (high[0] < low[0] || high[1] < low[1]) cursor["max"].fail("is below 'min'", "exchange them");
}

TransceiverGrid read_grid(const JsonCursor& cursor, const StoreNames& names) {
  cursor.expect_keys({"type", "min", "max", "spacing", "z", "axis", "roll_deg"});
  TransceiverGrid grid;
  grid.type = names.transceiver_type(cursor["type"]);
  grid.min = read_corner(cursor["min"]);
  grid.max = read_corner(cursor["max"]);
  expect_extent(cursor, grid.min, grid.max);
  grid.spacing = cursor["spacing"].positive();
  grid.z = cursor["z"].number();
  if (const auto axis = cursor.find("axis")) grid.axis = read_direction(*axis);
  if (const auto roll = cursor.find("roll_deg")) grid.roll_deg = roll->number();
  const double count =
      ((grid.max[0] - grid.min[0]) / grid.spacing + 1) * ((grid.max[1] - grid.min[1]) / grid.spacing + 1);
  if (count > 1e6)
    cursor["spacing"].fail(fmt::format("makes a grid of {:.0f} candidates", count), "use a wider spacing");
  return grid;
}

Transceiver read_transceiver(const JsonCursor& cursor, const StoreNames& names) {
  cursor.expect_keys({"id", "position", "axis", "roll_deg", "type"});
  Transceiver unit;
  unit.id = cursor["id"].text();
  unit.position = read_point(cursor["position"]);
  if (const auto axis = cursor.find("axis")) unit.axis = read_direction(*axis);
  if (const auto roll = cursor.find("roll_deg")) unit.roll_deg = roll->number();
  unit.type = names.transceiver_type(cursor["type"]);
  return unit;
}

std::filesystem::path csv_path(const JsonCursor& section, const std::filesystem::path& folder) {
  section.expect_keys({"csv"});
  return folder / section["csv"].text();
}

}  // namespace

Vec3 read_point(const JsonCursor& cursor) {
  const auto v = cursor.numbers(3);
  return {v[0], v[1], v[2]};
}

Vec3 unit_direction(const Vec3& v, const std::string& where) {
  const double squared = length_squared(v);
  if (!(squared > 0)) throw InputError(where, "the direction is zero", "give it a length");
  return std::abs(squared - 1) < 1e-12 ? v : normalized(v);
}

Vec3 read_direction(const JsonCursor& cursor) {
  return unit_direction(read_point(cursor), cursor.where());
}

void read_labels(const JsonCursor& section, const StoreNames& names, const std::filesystem::path& folder,
                 Store& store) {
  if (section.is_object()) return read_labels_csv(csv_path(section, folder), names, store);
  for (const JsonCursor& cursor : section.elements()) {
    cursor.expect_keys({"id", "position", "normal", "type"});
    Label label{cursor["id"].text(), read_point(cursor["position"]), read_direction(cursor["normal"]),
                names.label_type(cursor["type"])};
    store.labels.push_back({std::move(label), cursor.where()});
  }
}

void read_transceivers(const JsonCursor& section, const StoreNames& names,
                       const std::filesystem::path& folder, Store& store) {
  section.expect_keys({"grids", "list", "keep_out", "installed"});
  if (const auto grids = section.find("grids"))
    for (const JsonCursor& cursor : grids->elements()) store.grids.push_back(read_grid(cursor, names));
  if (const auto list = section.find("list")) {
    if (list->is_object()) {
      read_transceivers_csv(csv_path(*list, folder), names, store);
    } else {
      for (const JsonCursor& cursor : list->elements())
        store.transceivers.push_back({read_transceiver(cursor, names), cursor.where()});
    }
  }
  if (const auto areas = section.find("keep_out"))
    for (const JsonCursor& cursor : areas->elements()) {
      cursor.expect_keys({"min", "max"});
      store.keep_out.push_back({read_corner(cursor["min"]), read_corner(cursor["max"])});
      expect_extent(cursor, store.keep_out.back().min, store.keep_out.back().max);
    }
  if (const auto installed = section.find("installed"))
    for (const JsonCursor& cursor : installed->elements())
      store.installed.push_back({cursor.text(), cursor.where()});
}

}  // namespace shelfbeam
