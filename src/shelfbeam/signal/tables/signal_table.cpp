#include "shelfbeam/signal/tables/signal_table.hpp"

#include <algorithm>
#include <unordered_set>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/math/places.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/signal/tables/formats.hpp"

namespace shelfbeam {

namespace {

void expect_one_installed(const SignalTable& table, const std::string& name) {
  for (const auto& mount : table.mounts) {
    const SignalTable::Transceiver* installed = nullptr;
    for (const std::uint32_t j : mount) {
      const SignalTable::Transceiver& unit = table.transceivers[j];
      if (!unit.installed) continue;
      if (installed != nullptr)
        throw InputError(
            name + ": /transceivers/installed",
            fmt::format("'{}' and '{}' are installed at the same mounting point", installed->id, unit.id),
            "keep one of them in the store, and simulate it again");
      installed = &unit;
    }
  }
}

}  // namespace

std::vector<std::vector<std::uint32_t>> shared_mounts(const SignalMatrix& matrix) {
  const Places places = places_of(positions_of(matrix.transceivers));
  std::vector<std::vector<std::uint32_t>> mounts(places.count);
  for (std::uint32_t j = 0; j < matrix.columns(); ++j) mounts[places.of[j]].push_back(j);
  std::erase_if(mounts, [](const auto& mount) { return mount.size() < 2; });
  return mounts;
}

SignalTable make_signal_table(const SignalMatrix& matrix, const std::string& name) {
  SignalTable table;
  table.labels.reserve(matrix.rows());
  for (const LabelRow& label : matrix.labels)
    table.labels.push_back(
        {label.id, label.requirement, label.requirement, label.link_cost, label.signal_cost});
  table.transceivers.reserve(matrix.columns());
  for (const TransceiverColumn& unit : matrix.transceivers)
    table.transceivers.push_back({unit.id, unit.cost, unit.installed, unit.position});
  table.mounts = shared_mounts(matrix);
  expect_one_installed(table, name);

  const auto is_entry = [](float value) { return value > 0; };
  table.entries.reserve(
      static_cast<std::size_t>(std::count_if(matrix.mean.begin(), matrix.mean.end(), is_entry)));
  table.row_begin = {0};
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    const std::span<const float> row = matrix.mean_row(i);
    for (std::size_t j = 0; j < row.size(); ++j)
      if (is_entry(row[j])) table.entries.push_back({static_cast<std::uint32_t>(j), row[j]});
    table.row_begin.push_back(table.entries.size());
  }
  return table;
}

void set_requirement(SignalTable& table, double requirement) {
  for (SignalTable::Label& label : table.labels) label.requirement = label.single_requirement = requirement;
}

namespace detail {

namespace {

template <class Rows>
void check_unique(const Rows& rows, std::string_view kind, const std::string& name) {
  std::unordered_set<std::string_view> seen;
  seen.reserve(rows.size());
  for (const auto& row : rows)
    if (!seen.insert(row.id).second)
      throw InputError(name, fmt::format("has two {}s with the id '{}'", kind, row.id), "rename one of them");
}

}  // namespace

void number_labels(SignalTable& table, std::size_t count) {
  table.labels.resize(count);
  for (std::size_t i = 0; i < count; ++i) table.labels[i].id = fmt::format("L{}", i + 1);
}

void number_transceivers(SignalTable& table, std::size_t count) {
  table.transceivers.resize(count);
  for (std::size_t j = 0; j < count; ++j) table.transceivers[j].id = fmt::format("T{}", j + 1);
}

void check_unique_ids(const SignalTable& table, const std::string& name) {
  check_unique(table.labels, "label", name);
  check_unique(table.transceivers, "transceiver", name);
}

}  // namespace detail
}  // namespace shelfbeam
