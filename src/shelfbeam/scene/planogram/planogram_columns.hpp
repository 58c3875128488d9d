#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/base/csv.hpp"

namespace shelfbeam {

/// The columns of every planogram, by their indices in a record.
struct PlanogramColumns {
  std::size_t article = 0;
  std::optional<std::size_t> type, hook, tilt_deg, description;
  std::size_t required = 0, width = 0;  ///< fewest and most fields of a record
  std::vector<std::size_t> repeated;    ///< may be merged cells; each is a part of those before it
};

/// Of a file that names fixtures.
struct FixtureColumns : PlanogramColumns {
  std::size_t fixture = 0, face = 0, level = 0;
  std::size_t place = 0;  ///< `x` or `position`
  bool by_x = false;
  std::optional<std::size_t> y;
};

/// Of a file as planogram programs export them.
struct SegmentColumns : PlanogramColumns {
  std::size_t segment = 0, shelf = 0, sequence = 0;
  std::optional<std::size_t> planogram, product_width, facings;
};

/// A reader of the text, before the line that names the columns: titles and dates may stand above it.
/// Throws InputError.
CsvReader planogram_reader(std::string_view text, const std::string& file);

// Readers of the header of a file with this name. Throw InputError.

FixtureColumns read_fixture_columns(CsvReader& csv, std::string_view file);
SegmentColumns read_segment_columns(CsvReader& csv, std::string_view file);

/// Whether an optional column has a value in the current record.
inline bool has_value(const CsvReader& csv, const std::optional<std::size_t>& column) {
  return column && *column < csv.fields().size() && !csv.fields()[*column].empty();
}

}  // namespace shelfbeam
