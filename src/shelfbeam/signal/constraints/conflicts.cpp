#include "shelfbeam/signal/constraints/conflicts.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/csv.hpp"
#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/math/distinct_positions.hpp"
#include "shelfbeam/signal/text_file.hpp"

namespace shelfbeam {

namespace {

using Pairs = std::vector<std::pair<ColumnId, ColumnId>>;

void order(Pairs& pairs) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

/// The mounting point of every column.
std::vector<std::size_t> points_of(const SignalTable& table) {
  std::vector<std::size_t> point(table.columns());
  std::iota(point.begin(), point.end(), table.mounts.size());
  for (std::size_t k = 0; k < table.mounts.size(); ++k)
    for (const std::uint32_t j : table.mounts[k]) point[j] = k;
  return point;
}

}  // namespace

void add_conflicts(SignalTable& table, double metres, const std::string& name) {
  const auto& units = table.transceivers;
  for (const SignalTable::Transceiver& unit : units)
    if (!unit.position)
      throw InputError(name,
                       fmt::format("has no position of {}, so distances are unknown", in_quotes(unit.id)),
                       "use a signal file (HDF5), or name the pairs to forbid", Setting::forbidden_pairs);
  const std::vector<std::size_t> point = points_of(table);
  const double min_distance = metres - position_tolerance;
  // A sweep along x compares only few pairs if the distance is small compared with the shop.
  std::vector<std::uint32_t> along(table.columns());
  std::iota(along.begin(), along.end(), 0U);
  std::sort(along.begin(), along.end(),
            [&](std::uint32_t a, std::uint32_t b) { return units[a].position->x < units[b].position->x; });
  for (std::size_t first = 0; first < along.size(); ++first)
    for (std::size_t next = first + 1; next < along.size(); ++next) {
      const std::uint32_t a = along[first], b = along[next];
      const Vec3 between = *units[b].position - *units[a].position;
      if (between.x >= min_distance) break;
      const bool are_installed = units[a].installed && units[b].installed;
      if (length(between) < min_distance && point[a] != point[b] && !are_installed)
        table.conflicts.emplace_back(std::min(a, b), std::max(a, b));
    }
  order(table.conflicts);
  table.min_spacing = std::max(table.min_spacing, metres);
}

void forbid_pairs(SignalTable& table, const std::filesystem::path& path) {
  const char* const expected =
      "the first line must be 'a,b'; each other line must contain two transceiver ids";
  const std::string text = detail::read_text_file(path);
  CsvReader csv(text, path.string());
  if (!csv.next()) csv.fail("is empty", expected);
  if (csv.column_names() != std::vector<std::string>{"a", "b"})
    csv.fail("is not the header of a file of pairs", expected);

  const CsvIdLookup columns(table.transceivers, "transceiver", table.excluded);
  while (csv.next()) {
    csv.expect_fields(2, 2);
    const bool is_first = columns.is_ignored(csv, 0), is_second = columns.is_ignored(csv, 1);
    if (is_first || is_second) {
      if (!is_first) columns.read(csv, 0);
      if (!is_second) columns.read(csv, 1);
      continue;
    }
    const std::uint32_t a = columns.read(csv, 0), b = columns.read(csv, 1);
    if (a == b)
      csv.fail(fmt::format("names {} twice", in_quotes(csv.id(0))), "name two different transceivers");
    if (table.transceivers[a].installed && table.transceivers[b].installed)
      csv.fail(
          fmt::format("{} and {} are both installed or pinned", in_quotes(csv.id(0)), in_quotes(csv.id(1))),
          "remove the line, or choose only one of the two units");
    table.conflicts.emplace_back(std::min(a, b), std::max(a, b));
  }
  order(table.conflicts);
}

}  // namespace shelfbeam
