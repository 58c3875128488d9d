#include "shelfbeam/scene/device_csv.hpp"

#include <charconv>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/store_parts.hpp"

namespace shelfbeam {

namespace {

struct CsvLine {
  std::vector<std::string_view> fields;
  std::string where;  // "file:line"

  double number(std::size_t column, std::string_view name) const {
    const std::string_view field = fields[column];
    double value = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value))
      throw InputError(where, fmt::format("'{}' is no number for {}", field, name), "write a decimal number");
    return value;
  }
};

// Calls `use(line)` for each data line of a CSV that begins with the given columns.
template <class Use>
void each_line(const std::filesystem::path& path, std::string_view header, Use use) {
  const std::string text = read_file(path);
  const std::size_t columns = split(header, ',').size();
  std::size_t number = 0;
  std::string_view rest = text;
  bool seen_header = false;
  while (!rest.empty()) {
    const auto end = rest.find('\n');
    const std::string_view line = trim(rest.substr(0, end));
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
    ++number;
    if (line.empty()) continue;
    CsvLine row{split(line, ','), fmt::format("{}:{}", path.string(), number)};
    if (!seen_header) {
      auto names = row.fields;
      names.resize(std::min(names.size(), columns));
      if (join(names, ",") != header)
        throw InputError(row.where, "has another header", fmt::format("the first line must be {}", header));
      seen_header = true;
      continue;
    }
    if (row.fields.size() < columns)
      throw InputError(row.where, fmt::format("has {} fields", row.fields.size()),
                       fmt::format("{} are expected: {}", columns, header));
    if (row.fields[0].empty()) throw InputError(row.where, "has no id", "give every row an id");
    use(row);
  }
  if (!seen_header)
    throw InputError(path.string(), "is empty", fmt::format("the first line must be {}", header));
}

Vec3 vector_at(const CsvLine& line, std::size_t first, std::string_view name) {
  return {line.number(first, name), line.number(first + 1, name), line.number(first + 2, name)};
}

}  // namespace

void read_labels_csv(const std::filesystem::path& path, const StoreNames& names, Store& store) {
  each_line(path, "id,x,y,z,nx,ny,nz,type", [&](const CsvLine& line) {
    Label label;
    label.id = line.fields[0];
    label.position = vector_at(line, 1, "the position");
    label.normal = unit_direction(vector_at(line, 4, "the normal"), line.where);
    label.type = names.label_type(std::string(line.fields[7]), line.where);
    store.labels.push_back({std::move(label), line.where});
  });
}

void read_transceivers_csv(const std::filesystem::path& path, const StoreNames& names, Store& store) {
  each_line(path, "id,x,y,z,ax,ay,az,roll_deg,type", [&](const CsvLine& line) {
    Transceiver unit;
    unit.id = line.fields[0];
    unit.position = vector_at(line, 1, "the position");
    unit.axis = unit_direction(vector_at(line, 4, "the axis"), line.where);
    unit.roll_deg = line.number(7, "roll_deg");
    unit.type = names.transceiver_type(std::string(line.fields[8]), line.where);
    store.transceivers.push_back({std::move(unit), line.where});
  });
}

}  // namespace shelfbeam
