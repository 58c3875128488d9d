#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
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
#include "shelfbeam/scene/field_reader.hpp"
#include "shelfbeam/scene/fixture/fixture_builder.hpp"
#include "shelfbeam/scene/label/description_column.hpp"
#include "shelfbeam/scene/read_values.hpp"
#include "shelfbeam/scene/store/device_fields.hpp"
#include "shelfbeam/scene/store/scene_memory.hpp"
#include "shelfbeam/scene/store/store_parts.hpp"

namespace shelfbeam {

namespace {

void complete_extent(FieldReader& reader, const Vec2& low, const Vec2& high) {
  reader.rule({"min", "max"}, [&] {
    if (high[0] < low[0] || high[1] < low[1]) reader.json()["max"].fail("is below 'min'", "swap them");
  });
}

void complete(FieldReader& reader, const TransceiverGrid& grid) {
  complete_extent(reader, grid.min, grid.max);
  reader.rule({"min", "max", "spacing"}, [&] {
    const double count =
        ((grid.max[0] - grid.min[0]) / grid.spacing + 1) * ((grid.max[1] - grid.min[1]) / grid.spacing + 1);
    if (count > 1e6)
      reader.json()["spacing"].fail(fmt::format("produces a grid of {:.0f} candidates", count),
                                    "use a wider spacing");
  });
}

void complete(FieldReader& reader, const KeepOut& area) {
  complete_extent(reader, area.min, area.max);
  reader.rule({"z"}, [&] {
    if (area.high < area.low) reader.json()["z"].fail("has its second height below its first", "swap them");
  });
}

template <class T>
void complete(FieldReader&, const T&) {}

template <class To>
void read_devices(const JsonCursor& list, const StoreNames& names, const Store& store, Problems& problems,
                  To& to) {
  read_list(list, names, problems, to, [&](FieldReader& reader, const auto& value) {
    expect_running(store.cancel);
    complete(reader, value);
  });
}

// The file of an object with the key "csv".
TableFile csv_file(const JsonCursor& section, const StoreFolder& folder) {
  section.expect_keys({"csv", "encoding"});
  std::optional<Encoding> encoding;
  if (const auto given = section.find("encoding")) encoding = given->choice<Encoding>();
  return {folder.find(section["csv"]), encoding};
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
  std::optional<std::size_t> description;  // its column
  double farthest = 0;                     // the largest coordinate of the file so far, m

  Vec3 vector(std::size_t first) const {
    return {csv.finite_number(first), csv.finite_number(first + 1), csv.finite_number(first + 2)};
  }
  Vec3 point(std::size_t first) {
    const auto coordinate = [&](std::size_t field) {
      const auto [length, own] = csv.length(field, unit);
      const double value = read_coordinate(length, own, csv.where());
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
void each_record(const TableFile& table, const Columns& known, Store& store, Problems* problems, Use use) {
  const auto& [header, ours] = known;
  const InputFile& file = table.file;
  const std::string text = table.read(store.warnings);
  CsvReader csv(text, file.name());
  const std::string expected = fmt::format("the first line must be {}", header);
  if (!csv.next()) throw InputError(file.name(), "is empty", expected);
  if (!continues_with(csv, 0, header)) csv.fail("has an unknown header", expected);
  const std::size_t required = split(header, ',').size(), width = csv.fields().size();
  Record record{csv, continues_with(csv, required, ours) ? LengthUnit::m : store.unit,
                description_column(csv, required)};
  const std::string meaning = fmt::format(": {}", header);
  SceneMemory memory(store.memory);
  while (csv.next()) {
    expect_running(store.cancel);
    const auto use_record = [&] {
      csv.expect_fields(required, width, meaning);
      use(record);
    };
    if (problems != nullptr)
      problems->collect(use_record);
    else
      use_record();
    memory.add(device_bytes, csv.where());
  }
  expect_unit(record, file.name());
  if (auto warning = csv.warning_of_ids()) store.warnings.push_back(std::move(*warning));
}

}  // namespace

void read_labels(const JsonCursor& section, const StoreNames& names, const StoreFolder& folder, Store& store,
                 Problems& problems) {
  if (section.is_object()) return read_labels_csv(csv_file(section, folder), names, store, &problems);
  read_devices(section, names, store, problems, store.labels);
}

void read_transceivers(const JsonCursor& section, const StoreNames& names, const StoreFolder& folder,
                       Store& store, Problems& problems) {
  problems.collect([&] {
    section.expect_keys(
        {"grids", "areas", "rails", "on", "list", "keep_out", "installed", "pinned", "excluded", "selected"});
  });
  const auto each = [&](const char* key, const auto& read) {
    if (const auto list = section.find(key)) problems.collect([&] { read(*list); });
  };
  read_mounts(section, names, store, problems);
  each("grids", [&](const JsonCursor& list) { read_devices(list, names, store, problems, store.grids); });
  each("list", [&](const JsonCursor& list) {
    if (list.is_object())
      read_transceivers_csv(csv_file(list, folder), names, store, &problems);
    else
      read_devices(list, names, store, problems, store.transceivers);
  });
  each("keep_out",
       [&](const JsonCursor& list) { read_devices(list, names, store, problems, store.keep_out); });
  const auto ids = [&](const char* key, std::vector<Listed<std::string>>& units) {
    each(key, [&](const JsonCursor& list) {
      for (const JsonCursor& id : list.elements())
        problems.collect([&] { units.push_back({id.text(), id.where()}); });
    });
  };
  ids("installed", store.installed);
  ids("pinned", store.pinned);
  ids("excluded", store.excluded);
  ids("selected", store.selected);
}

void read_labels_csv(const TableFile& file, const StoreNames& names, Store& store, Problems* problems) {
  each_record(file, label_columns, store, problems, [&](Record& record) {
    CsvReader& csv = record.csv;
    Label label;
    label.id = csv.id(0);
    label.position = record.point(1);
    label.normal = unit_direction(record.vector(4), csv.where());
    label.type = names.label_type(csv.text(7), csv.where());
    if (record.description && *record.description < csv.fields().size())
      label.description = description_of(csv.text(*record.description));
    store.labels.push_back({std::move(label), csv.where()});
  });
}

void read_transceivers_csv(const TableFile& file, const StoreNames& names, Store& store, Problems* problems) {
  each_record(file, unit_columns, store, problems, [&](Record& record) {
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
