#include "shelfbeam/scene/device_csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/read_values.hpp"

namespace shelfbeam {

namespace {

// The fields of a line without the blanks around them; one in quotes may hold commas, and quotes twice.
std::vector<std::string> fields_of(std::string_view line, const std::string& where) {
  std::vector<std::string> fields;
  while (true) {
    std::string field;
    line = trim(line);
    if (line.starts_with('"')) {
      std::size_t at = 1;
      for (;; ++at) {
        if (at >= line.size()) throw InputError(where, "has a quote that is never closed", "close it");
        if (line[at] == '"' && !line.substr(at + 1).starts_with('"')) break;
        if (line[at] == '"') ++at;
        field += line[at];
      }
      line = trim(line.substr(at + 1));
      if (!line.empty() && line.front() != ',')
        throw InputError(where, "goes on after a closing quote", "double the quotes that belong to a field");
    } else {
      field = trim(line.substr(0, line.find(',')));
    }
    fields.push_back(std::move(field));
    const std::size_t comma = line.find(',');
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

struct CsvLine {
  std::vector<std::string> fields;
  std::string where;  // "file:line"

  double number(std::size_t column, std::string_view name) const {
    const std::string& field = fields[column];
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
  if (!is_utf8(text)) throw InputError(path.string(), "is not UTF-8", "save it in that encoding");
  const auto columns = static_cast<std::size_t>(std::count(header.begin(), header.end(), ',')) + 1;
  std::size_t number = 0;
  std::string_view rest = text;
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
  bool seen_header = false;
  while (!rest.empty()) {
    const auto end = rest.find('\n');
    const std::string_view line = trim(rest.substr(0, end));
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
    ++number;
    if (line.empty()) continue;
    CsvLine row{{}, fmt::format("{}:{}", path.string(), number)};
    row.fields = fields_of(line, row.where);
    if (!seen_header) {
      auto names = row.fields;
      names.resize(std::min(names.size(), columns));
      if (fmt::format("{}", fmt::join(names, ",")) != header)
        throw InputError(row.where, "has another header", fmt::format("the first line must be {}", header));
      seen_header = true;
      continue;
    }
    if (row.fields.size() < columns)
      throw InputError(row.where, fmt::format("has {} fields", row.fields.size()),
                       fmt::format("{} are expected: {}", columns, header));
    row.fields[0] = check_name(row.fields[0], row.where + ": id");
    use(row);
  }
  if (!seen_header)
    throw InputError(path.string(), "is empty", fmt::format("the first line must be {}", header));
}

Vec3 vector_at(const CsvLine& line, std::size_t first, std::string_view name) {
  return {line.number(first, name), line.number(first + 1, name), line.number(first + 2, name)};
}

Vec3 point_at(const CsvLine& line, std::size_t first) {
  const Vec3 p = vector_at(line, first, "the position");
  for (int axis = 0; axis < 3; ++axis) check_coordinate(p[axis], line.where);
  return p;
}

}  // namespace

void read_labels_csv(const std::filesystem::path& path, const StoreNames& names, Store& store) {
  each_line(path, "id,x,y,z,nx,ny,nz,type", [&](const CsvLine& line) {
    Label label;
    label.id = line.fields[0];
    label.position = point_at(line, 1);
    label.normal = unit_direction(vector_at(line, 4, "the normal"), line.where);
    label.type = names.label_type(line.fields[7], line.where);
    store.labels.push_back({std::move(label), line.where});
  });
}

void read_transceivers_csv(const std::filesystem::path& path, const StoreNames& names, Store& store) {
  each_line(path, "id,x,y,z,ax,ay,az,roll_deg,type", [&](const CsvLine& line) {
    Transceiver unit;
    unit.id = line.fields[0];
    unit.position = point_at(line, 1);
    unit.axis = unit_direction(vector_at(line, 4, "the axis"), line.where);
    unit.roll_deg = line.number(7, "roll_deg");
    if (!(std::abs(unit.roll_deg) <= 360))
      throw InputError(line.where, fmt::format("has the roll_deg {}", unit.roll_deg),
                       "use a value from -360 to 360");
    unit.type = names.transceiver_type(line.fields[8], line.where);
    store.transceivers.push_back({std::move(unit), line.where});
  });
}

}  // namespace shelfbeam
