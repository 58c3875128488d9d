#include "shelfbeam/signal/constraints/unit_choice.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"

namespace shelfbeam {

namespace {

// Whether each column matches one of the patterns. A pattern may match only `others` instead.
std::vector<bool> matches(const std::vector<std::string>& patterns, const SignalTable& table,
                          std::span<const std::string> others, const std::string& name, Setting setting) {
  std::vector<std::string_view> ids;
  ids.reserve(table.columns());
  for (const SignalTable::Transceiver& unit : table.transceivers) ids.emplace_back(unit.id);
  const auto is_other = [&](const std::string& pattern) {
    return std::any_of(others.begin(), others.end(),
                       [&](const std::string& id) { return matches_glob(id, pattern); });
  };
  std::vector<bool> is_match(table.columns());
  for (const std::string& pattern : patterns) {
    const std::vector<std::uint32_t> found = matching_ids(pattern, ids);
    if (found.empty() && !is_other(pattern))
      throw InputError(name, fmt::format("has no transceiver {}", in_quotes(pattern)), suggest(pattern, ids),
                       setting);
    for (const std::uint32_t j : found) is_match[j] = true;
  }
  return is_match;
}

void remove_columns(const std::vector<bool>& is_excluded, SignalTable& table) {
  std::vector<ColumnId> number(table.columns());  // of the columns that are left
  std::uint32_t left = 0;
  std::vector<SignalTable::Transceiver> units;
  for (std::size_t j = 0; j < is_excluded.size(); ++j)
    if (is_excluded[j]) {
      table.excluded.push_back(std::move(table.transceivers[j].id));
    } else {
      number[j] = left++;
      units.push_back(std::move(table.transceivers[j]));
    }
  table.transceivers = std::move(units);
  for (auto& mount : table.mounts) {
    std::erase_if(mount, [&](std::uint32_t j) { return is_excluded[j]; });
    for (ColumnId& j : mount) j = number[j];
  }
  std::erase_if(table.mounts, [](const auto& mount) { return mount.size() < 2; });
  std::erase_if(table.conflicts,
                [&](const auto& pair) { return is_excluded[pair.first] || is_excluded[pair.second]; });
  for (auto& [a, b] : table.conflicts) {
    a = number[a];
    b = number[b];
  }
  std::vector<SignalEntry> entries;
  entries.reserve(table.entries.size());
  std::vector<std::size_t> row_begin{0};
  row_begin.reserve(table.row_begin.size());
  for (std::size_t i = 0; i < table.rows(); ++i) {
    for (const SignalEntry& entry : table.row(i))
      if (!is_excluded[entry.transceiver]) entries.push_back({number[entry.transceiver], entry.signal});
    row_begin.push_back(entries.size());
  }
  table.entries = std::move(entries);
  table.row_begin = std::move(row_begin);
}

}  // namespace

void UnitChoice::apply(SignalTable& table, const std::string& name) const {
  const std::vector<bool> is_pinned = matches(pinned, table, {}, name, Setting::pinned);
  const std::vector<bool> is_excluded = matches(excluded, table, table.excluded, name, Setting::excluded);
  for (std::size_t j = 0; j < table.columns(); ++j) {
    SignalTable::Transceiver& unit = table.transceivers[j];
    if (is_pinned[j] && !unit.installed) unit.installed = unit.pinned = true;
    if (is_excluded[j] && unit.installed)
      throw InputError(
          name,
          fmt::format("{} is {} and excluded", in_quotes(unit.id), unit.pinned ? "pinned" : "installed"),
          "choose one of the two", Setting::excluded);
  }
  for (const auto& mount : table.mounts) {
    const auto is_given = [&](std::uint32_t j) { return table.transceivers[j].installed; };
    const auto first = std::find_if(mount.begin(), mount.end(), is_given);
    if (first == mount.end()) continue;
    if (const auto second = std::find_if(first + 1, mount.end(), is_given); second != mount.end())
      throw InputError(
          name,
          fmt::format("{} and {} share a mounting point, so they cannot both be part of a plan",
                      in_quotes(table.transceivers[*first].id), in_quotes(table.transceivers[*second].id)),
          "pin one of the two", Setting::pinned);
  }
  if (std::find(is_excluded.begin(), is_excluded.end(), false) == is_excluded.end())
    throw InputError(name, "has no other transceivers than the excluded ones", "exclude fewer",
                     Setting::excluded);
  // Given units stay, whatever their distance.
  std::erase_if(table.conflicts, [&](const auto& pair) {
    return table.transceivers[pair.first].installed && table.transceivers[pair.second].installed;
  });
  if (!excluded.empty()) remove_columns(is_excluded, table);
}

}  // namespace shelfbeam
