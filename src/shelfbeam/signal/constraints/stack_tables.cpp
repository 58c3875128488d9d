#include "shelfbeam/signal/constraints/stack_tables.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/math/distinct_positions.hpp"

namespace shelfbeam {

namespace {

constexpr const char* same_store = "simulate all scenarios with the same transceivers";

void expect_same(const SignalTable::Transceiver& unit, const SignalTable::Transceiver& first,
                 const NamedTable& scenario, const std::string& first_file) {
  const auto fail = [&](const std::string& here, const std::string& there) {
    throw InputError(scenario.file,
                     fmt::format("{} {}, but in '{}' it {}", in_quotes(unit.id), here, first_file, there),
                     same_store);
  };
  if (unit.cost != first.cost) fail(fmt::format("costs {}", unit.cost), fmt::format("costs {}", first.cost));
  if (unit.pinned != first.pinned)
    fail(unit.pinned ? "is pinned" : "is not pinned", unit.pinned ? "is not" : "is");
  if (unit.installed != first.installed)
    fail(unit.installed ? "is installed" : "is not installed", unit.installed ? "is not" : "is");
  if (!unit.position || !first.position) return;
  const Vec3 between = *unit.position - *first.position;
  for (const int axis : {0, 1, 2})
    if (std::abs(between[axis]) > position_tolerance) fail("is at one position", "is at another");
}

/// For every column of this table, its column in the first table.
std::vector<ColumnId> columns_of(const NamedTable& scenario, const NamedTable& first) {
  std::unordered_map<std::string_view, std::uint32_t> column;
  for (std::uint32_t j = 0; j < first.table.columns(); ++j) column.emplace(first.table.transceivers[j].id, j);
  std::vector<ColumnId> result;
  for (const SignalTable::Transceiver& unit : scenario.table.transceivers) {
    const auto found = column.find(unit.id);
    if (found == column.end())
      throw InputError(scenario.file,
                       fmt::format("has a transceiver {}, but '{}' does not", in_quotes(unit.id), first.file),
                       same_store);
    expect_same(unit, first.table.transceivers[found->second], scenario, first.file);
    result.push_back(found->second);
  }
  if (scenario.table.currency != first.table.currency)
    throw InputError(scenario.file,
                     fmt::format("has prices in {}, but '{}' in {}", in_quotes(scenario.table.currency),
                                 first.file, in_quotes(first.table.currency)),
                     same_store);
  if (result.size() == first.table.columns()) return result;
  const std::unordered_set<std::uint32_t> there(result.begin(), result.end());
  for (std::uint32_t j = 0; j < first.table.columns(); ++j)
    if (!there.contains(j))
      throw InputError(scenario.file,
                       fmt::format("has no transceiver {}, but '{}' does",
                                   in_quotes(first.table.transceivers[j].id), first.file),
                       same_store);
  return result;
}

void append(SignalTable& all, const NamedTable& scenario, const std::vector<ColumnId>& column) {
  all.scenarios.push_back({scenario.name, all.rows(), scenario.table.rows()});
  for (std::size_t i = 0; i < scenario.table.rows(); ++i) {
    all.labels.push_back(scenario.table.labels[i]);
    all.labels.back().id = scenario.name + ":" + all.labels.back().id;
    const auto begin = static_cast<std::ptrdiff_t>(all.entries.size());
    for (const SignalEntry& entry : scenario.table.row(i))
      all.entries.push_back({column[entry.transceiver], entry.signal});
    std::sort(all.entries.begin() + begin, all.entries.end(),
              [](const SignalEntry& a, const SignalEntry& b) { return a.transceiver < b.transceiver; });
    all.row_begin.push_back(all.entries.size());
  }
}

}  // namespace

SignalTable stack_tables(std::vector<NamedTable> tables) {
  if (tables.size() == 1) return std::move(tables.front().table);
  for (std::size_t k = 0; k < tables.size(); ++k)
    for (std::size_t earlier = 0; earlier < k; ++earlier)
      if (tables[k].name == tables[earlier].name)
        throw InputError(tables[k].file,
                         fmt::format("has the scenario name '{}', which '{}' has already", tables[k].name,
                                     tables[earlier].file),
                         "give each scenario its own file name");
  SignalTable all;
  all.transceivers = tables.front().table.transceivers;
  all.excluded = tables.front().table.excluded;
  all.currency = tables.front().table.currency;
  all.row_begin = {0};
  for (NamedTable& scenario : tables) {
    const std::vector<ColumnId> column = columns_of(scenario, tables.front());
    append(all, scenario, column);
    // Positions, and with them mounting points, may be missing in some files.
    for (std::size_t j = 0; j < column.size(); ++j)
      if (!all.transceivers[column[j]].position)
        all.transceivers[column[j]].position = scenario.table.transceivers[j].position;
    if (all.mounts.empty()) {
      all.mounts = scenario.table.mounts;
      for (auto& mount : all.mounts) {
        for (ColumnId& j : mount) j = column[j];
        std::sort(mount.begin(), mount.end());
      }
    }
    if (&scenario != &tables.front()) scenario.table.entries = {};
  }
  return all;
}

}  // namespace shelfbeam
