#include "shelfbeam/scene/planogram/planogram_columns.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/label/description_column.hpp"

namespace shelfbeam {

namespace {

using ColumnNames = std::span<const std::string_view>;

constexpr const char *
    expected_by_fixture = "its header must have the columns article, fixture, face, level, and x or position",
   *expected_by_segment =
       "with 'segments' of the planogram, its header must have the columns article, segment, shelf and "
       "sequence";
constexpr auto known_columns = std::to_array<std::string_view>(
    {"article", "fixture", "face", "level", "x", "y", "position", "type", "hook", "tilt_deg"});

// The names of columns in the files of planogram programs, the preferred ones first.
constexpr auto article_names = std::to_array<std::string_view>({"article", "upc", "ean", "gtin", "sku"});
constexpr auto planogram_names =
    std::to_array<std::string_view>({"planogram", "planogram_id", "planogram_name"});
constexpr auto segment_names = std::to_array<std::string_view>({"segment", "bay"});
constexpr auto shelf_names = std::to_array<std::string_view>({"shelf", "level"});
constexpr auto sequence_names = std::to_array<std::string_view>({"sequence", "position"});
constexpr auto width_names = std::to_array<std::string_view>({"width"});
constexpr auto facings_names = std::to_array<std::string_view>({"facings", "hfacings", "facings_wide"});

class PlanogramHeader {
 public:
  PlanogramHeader(CsvReader& csv, std::string_view file, const char* expected)
      : csv_(csv), expected_(expected) {
    if (!csv.next()) throw InputError(std::string(file), "is empty", expected);
    names_ = column_keys(csv);
  }

  /// With several of the names, it would depend on the program that wrote the file which one is meant.
  std::size_t required(ColumnNames known) const {
    const auto found = optional(known);
    std::string_view first;
    for (const std::string_view name : known) {
      if (std::find(names_.begin(), names_.end(), name) == names_.end()) continue;
      if (!first.empty())
        csv_.fail(fmt::format("has both columns {} and {}", in_quotes(first), in_quotes(name)),
                  "remove or rename one of the two");
      first = name;
    }
    if (!found) csv_.fail(fmt::format("has no column {}", in_quotes(known.front())), meant(known.front()));
    return *found;
  }
  std::size_t required(std::string_view name) const { return required(ColumnNames(&name, 1)); }
  std::optional<std::size_t> optional(ColumnNames known) const {
    for (const std::string_view name : known) {
      if (std::count(names_.begin(), names_.end(), name) > 1) fail_repeated(csv_, name);
      if (const auto found = std::find(names_.begin(), names_.end(), name); found != names_.end())
        return static_cast<std::size_t>(found - names_.begin());
    }
    return {};
  }
  std::optional<std::size_t> optional(std::string_view name) const { return optional(ColumnNames(&name, 1)); }

  /// The columns that all planograms have, except the article.
  void read_common(PlanogramColumns& columns) const {
    columns.width = names_.size();
    columns.type = optional("type");
    columns.hook = optional("hook");
    columns.tilt_deg = optional("tilt_deg");
    columns.description = description_column(csv_);
    require(columns, columns.article);
    // A file with types has one in every record, even if it is empty.
    require(columns, columns.type.value_or(0));
  }
  static void require(PlanogramColumns& columns, std::size_t column) {
    columns.required = std::max(columns.required, column + 1);
  }

 private:
  std::string meant(std::string_view name) const {
    const std::string near = nearest(name, csv_.fields());
    const bool is_known =
        std::find(known_columns.begin(), known_columns.end(), lower_case(near)) != known_columns.end();
    return near.empty() || is_known ? expected_ : fmt::format("rename {} if it is meant", in_quotes(near));
  }

  CsvReader& csv_;
  const char* expected_;
  std::vector<std::string> names_;
};

// The number of records above the one with an article column, if they are separated so.
std::optional<int> records_above(std::string_view text, const std::string& file, char separator) try {
  constexpr int most = 20;
  CsvReader csv(text, file, separator);
  for (int above = 0; above <= most && csv.next(); ++above) {
    const std::vector<std::string> names = column_keys(csv);
    if (names.size() > 1 && std::ranges::find_first_of(names, article_names) != names.end()) return above;
  }
  return {};
} catch (const InputError&) {  // it may have another separator
  return {};
}

}  // namespace

CsvReader planogram_reader(std::string_view text, const std::string& file) {
  for (const char separator : {',', ';', '\t'})
    if (const auto above = records_above(text, file, separator); above.value_or(0) > 0) {
      CsvReader csv(text, file, separator);
      for (int k = 0; k < *above; ++k) csv.next();
      return csv;
    }
  return CsvReader(text, file);
}

FixtureColumns read_fixture_columns(CsvReader& csv, std::string_view file) {
  const PlanogramHeader header(csv, file, expected_by_fixture);
  if (!header.optional("fixture") && header.optional(segment_names) && header.optional(shelf_names))
    csv.fail("names segments instead of fixtures", "add 'segments' to 'planogram' of the store");
  FixtureColumns columns;
  columns.article = header.required(article_names);
  columns.fixture = header.required("fixture");
  columns.face = header.required("face");
  columns.level = header.required("level");
  const auto x = header.optional("x"), position = header.optional("position");
  if (x && position) csv.fail("has both columns 'x' and 'position'", "remove one of the two");
  columns.by_x = x.has_value();
  columns.place = x ? *x : header.required("position");
  columns.y = header.optional("y");
  header.read_common(columns);
  columns.repeated = {columns.fixture, columns.face, columns.level};
  for (const std::size_t k : {columns.fixture, columns.face, columns.level, columns.place})
    PlanogramHeader::require(columns, k);
  return columns;
}

SegmentColumns read_segment_columns(CsvReader& csv, std::string_view file) {
  const PlanogramHeader header(csv, file, expected_by_segment);
  SegmentColumns columns;
  columns.article = header.required(article_names);
  columns.segment = header.required(segment_names);
  columns.shelf = header.required(shelf_names);
  columns.sequence = header.required(sequence_names);
  columns.planogram = header.optional(planogram_names);
  columns.product_width = header.optional(width_names);
  columns.facings = header.optional(facings_names);
  header.read_common(columns);
  if (columns.planogram) columns.repeated.push_back(*columns.planogram);
  columns.repeated.insert(columns.repeated.end(), {columns.segment, columns.shelf});
  for (const std::size_t k :
       {columns.segment, columns.shelf, columns.sequence, columns.planogram.value_or(0)})
    PlanogramHeader::require(columns, k);
  return columns;
}

}  // namespace shelfbeam
