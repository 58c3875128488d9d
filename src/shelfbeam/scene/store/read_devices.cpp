#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/csv.hpp"
#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/expect_running.hpp"
#include "shelfbeam/scene/fixture/fixture_builder.hpp"
#include "shelfbeam/scene/read_values.hpp"
#include "shelfbeam/scene/store/scene_memory.hpp"
#include "shelfbeam/scene/store/store_parts.hpp"

namespace shelfbeam {

namespace {

void expect_extent(const JsonCursor& cursor, const Vec2& low, const Vec2& high) {
  if (high[0] < low[0] || high[1] < low[1]) cursor["max"].fail("is below 'min'", "swap them");
}

TransceiverGrid read_grid(const JsonCursor& cursor, const StoreNames& names) {
  cursor.expect_keys({"type", "min", "max", "spacing", "z", "axis", "roll_deg"});
  TransceiverGrid grid;
  grid.type = names.transceiver_type(cursor["type"]);
  grid.min = read_plan_point(cursor["min"]);
  grid.max = read_plan_point(cursor["max"]);
  expect_extent(cursor, grid.min, grid.max);
  grid.spacing = read_length(cursor["spacing"]);
  grid.z = read_coordinate(cursor["z"]);
  if (const auto axis = cursor.find("axis")) grid.axis = read_direction(*axis);
  if (const auto roll = cursor.find("roll_deg")) grid.roll_deg = read_angle_deg(*roll);
  const double count =
      ((grid.max[0] - grid.min[0]) / grid.spacing + 1) * ((grid.max[1] - grid.min[1]) / grid.spacing + 1);
  if (count > 1e6)
    cursor["spacing"].fail(fmt::format("produces a grid of {:.0f} candidates", count), "use a wider spacing");
  return grid;
}

double read_factor(const JsonCursor& device, std::string_view key) {
  const auto factor = device.find(key);
  return factor ? factor->number(1e-3, 1e3) : 1;
}

Transceiver read_transceiver(const JsonCursor& cursor, const StoreNames& names) {
  cursor.expect_keys({"id", "position", "axis", "roll_deg", "type", "relative_power"});
  Transceiver unit;
  unit.id = read_name(cursor["id"]);
  unit.position = read_point(cursor["position"]);
  if (const auto axis = cursor.find("axis")) unit.axis = read_direction(*axis);
  if (const auto roll = cursor.find("roll_deg")) unit.roll_deg = read_angle_deg(*roll);
  unit.type = names.transceiver_type(cursor["type"]);
  unit.relative_power = read_factor(cursor, "relative_power");
  return unit;
}

std::filesystem::path csv_path(const JsonCursor& section, const StoreFolder& folder) {
  section.expect_keys({"csv"});
  return folder.find(section["csv"]);
}

// The columns of a device CSV. `ours` continue them in the file that `plan` writes, which is always in
// metres.
struct Columns {
  std::string_view header, ours;
};
constexpr Columns label_columns{"id,x,y,z,nx,ny,nz,type", "requirement,signal,margin_db"};
constexpr Columns unit_columns{"id,x,y,z,ax,ay,az,roll_deg,type", "cost,installed,reaches_alone"};

// The current record of a file and the unit of its coordinates.
struct Record {
  CsvReader& csv;
  LengthUnit unit;
  double farthest = 0;  // the largest coordinate of the file so far, m

  Vec3 vector(std::size_t first) const {
    return {csv.number(first), csv.number(first + 1), csv.number(first + 2)};
  }
  Vec3 point(std::size_t first) {
    const auto coordinate = [&](std::size_t field) {
      const double value = read_coordinate(csv.number(field), unit, csv.where());
      farthest = std::max(farthest, std::abs(value));
      return value;
    };
    return {coordinate(first), coordinate(first + 1), coordinate(first + 2)};
  }
};

// Refuses positions in metres in a store of another unit, as far as they can be recognised: a shop is larger
// than this.
void expect_unit(const Record& record, const std::string& file) {
  constexpr double corner = 0.1;  // m
  if (record.unit != LengthUnit::m && record.farthest > 0 && record.farthest <= corner)
    throw InputError(
        file,
        fmt::format("has all positions within {} m of the origin, because 'units' of the store is '{}'",
                    corner, to_text(record.unit)),
        "give positions in that unit, or keep all columns of a file that 'plan' wrote in m");
}

bool continues_with(const CsvReader& csv, std::size_t first, std::string_view header) {
  const std::vector<std::string_view> columns = split(header, ',');
  const std::vector<std::string> names = csv.column_names();
  return names.size() >= first + columns.size() &&
         std::equal(columns.begin(), columns.end(), names.begin() + static_cast<std::ptrdiff_t>(first));
}

// Calls `use(record)` for each record of a CSV whose first columns are those of its header.
template <class Use>
void each_record(const std::filesystem::path& path, const Columns& known, Store& store, Use use) {
  const auto& [header, ours] = known;
  const std::string text = read_file(path);
  CsvReader csv(text, path.string());
  const std::string expected = fmt::format("the first line must be {}", header);
  if (!csv.next()) throw InputError(path.string(), "is empty", expected);
  if (!continues_with(csv, 0, header)) csv.fail("has an unknown header", expected);
  const std::size_t required = split(header, ',').size(), width = csv.fields().size();
  Record record{csv, continues_with(csv, required, ours) ? LengthUnit::m : store.unit};
  const std::string meaning = fmt::format(": {}", header);
  SceneMemory memory(store.memory);
  while (csv.next()) {
    expect_running(store.cancel);
    csv.expect_fields(required, width, meaning);
    use(record);
    memory.add(device_bytes, csv.where());
  }
  expect_unit(record, path.string());
  if (std::string warning = csv.warning_of_ids(); !warning.empty())
    store.warnings.push_back(std::move(warning));
}

}  // namespace

Label read_label(const JsonCursor& json, const StoreNames& names) {
  json.expect_keys({"id", "position", "normal", "type", "relative_sensitivity"});
  return {read_name(json["id"]), read_point(json["position"]), read_direction(json["normal"]),
          names.label_type(json["type"]), read_factor(json, "relative_sensitivity")};
}

void read_labels(const JsonCursor& section, const StoreNames& names, const StoreFolder& folder,
                 Store& store) {
  if (section.is_object()) return read_labels_csv(csv_path(section, folder), names, store);
  for (const JsonCursor& cursor : section.elements()) {
    expect_running(store.cancel);
    store.labels.push_back({read_label(cursor, names), cursor.where()});
  }
}

void read_transceivers(const JsonCursor& section, const StoreNames& names, const StoreFolder& folder,
                       Store& store) {
  section.expect_keys({"grids", "areas", "rails", "on", "list", "keep_out", "installed"});
  read_mounts(section, names, store);
  if (const auto grids = section.find("grids"))
    for (const JsonCursor& cursor : grids->elements()) store.grids.push_back(read_grid(cursor, names));
  if (const auto list = section.find("list")) {
    if (list->is_object()) {
      read_transceivers_csv(csv_path(*list, folder), names, store);
    } else {
      for (const JsonCursor& cursor : list->elements()) {
        expect_running(store.cancel);
        store.transceivers.push_back({read_transceiver(cursor, names), cursor.where()});
      }
    }
  }
  if (const auto areas = section.find("keep_out"))
    for (const JsonCursor& cursor : areas->elements()) store.keep_out.push_back(read_keep_out(cursor));
  if (const auto installed = section.find("installed"))
    for (const JsonCursor& cursor : installed->elements())
      store.installed.push_back({cursor.text(), cursor.where()});
}

void read_labels_csv(const std::filesystem::path& path, const StoreNames& names, Store& store) {
  each_record(path, label_columns, store, [&](Record& record) {
    CsvReader& csv = record.csv;
    Label label;
    label.id = csv.id(0);
    label.position = record.point(1);
    label.normal = unit_direction(record.vector(4), csv.where());
    label.type = names.label_type(csv.text(7), csv.where());
    store.labels.push_back({std::move(label), csv.where()});
  });
}

void read_transceivers_csv(const std::filesystem::path& path, const StoreNames& names, Store& store) {
  each_record(path, unit_columns, store, [&](Record& record) {
    CsvReader& csv = record.csv;
    Transceiver unit;
    unit.id = csv.id(0);
    unit.position = record.point(1);
    unit.axis = unit_direction(record.vector(4), csv.where());
    unit.roll_deg = csv.number(7);
    if (!(std::abs(unit.roll_deg) <= 360))
      csv.fail(7, fmt::format("is {}", unit.roll_deg), "use a value from -360 to 360");
    unit.type = names.transceiver_type(csv.text(8), csv.where());
    store.transceivers.push_back({std::move(unit), csv.where()});
  });
}

}  // namespace shelfbeam
