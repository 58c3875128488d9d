#include "shelfbeam/scene/planogram/planogram_columns.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/label/description_column.hpp"

namespace shelfbeam {

namespace {

constexpr const char* expected_columns =
    "the first line must have the columns article, fixture, face, level, and x or position";
constexpr auto known_columns = std::to_array<std::string_view>(
    {"article", "fixture", "face", "level", "x", "y", "position", "type", "hook", "tilt_deg"});

class PlanogramHeader {
 public:
  explicit PlanogramHeader(CsvReader& csv) : csv_(csv), names_(csv.column_names()) {}

  std::size_t size() const { return names_.size(); }
  bool has(std::string_view name) const { return find(name) < names_.size(); }
  std::size_t required(std::string_view name) const {
    const std::size_t k = find(name);
    if (k == names_.size()) csv_.fail(fmt::format("has no column {}", in_quotes(name)), meant(name));
    return k;
  }
  std::optional<std::size_t> optional(std::string_view name) const {
    return has(name) ? std::optional(find(name)) : std::nullopt;
  }

 private:
  std::size_t find(std::string_view name) const {
    if (std::count(names_.begin(), names_.end(), name) > 1)
      csv_.fail(fmt::format("has several columns {}", in_quotes(name)), "rename or remove all but one");
    return static_cast<std::size_t>(std::find(names_.begin(), names_.end(), name) - names_.begin());
  }
  std::string meant(std::string_view name) const {
    const std::string near = nearest(name, csv_.fields());
    const bool is_known =
        std::find(known_columns.begin(), known_columns.end(), lower_case(near)) != known_columns.end();
    return near.empty() || is_known ? expected_columns
                                    : fmt::format("rename {} if it is meant", in_quotes(near));
  }

  CsvReader& csv_;
  std::vector<std::string> names_;
};

}  // namespace

PlanogramColumns read_planogram_header(CsvReader& csv, std::string_view file) {
  if (!csv.next()) throw InputError(std::string(file), "is empty", expected_columns);
  const PlanogramHeader header(csv);
  PlanogramColumns columns;
  columns.width = header.size();
  columns.article = header.required("article");
  columns.fixture = header.required("fixture");
  columns.face = header.required("face");
  columns.level = header.required("level");
  columns.by_x = header.has("x");
  if (columns.by_x && header.has("position"))
    csv.fail("has both columns 'x' and 'position'", "remove one of the two");
  columns.place = header.required(columns.by_x ? "x" : "position");
  columns.y = header.optional("y");
  columns.type = header.optional("type");
  columns.hook = header.optional("hook");
  columns.tilt_deg = header.optional("tilt_deg");
  columns.description = description_column(csv);
  // A file with types has one in every record, even if it is empty.
  for (const std::size_t k : {columns.article, columns.fixture, columns.face, columns.level, columns.place,
                              columns.type.value_or(0)})
    columns.required = std::max(columns.required, k + 1);
  return columns;
}

}  // namespace shelfbeam
