#include "shelfbeam/plan/decisive_rows.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <set>
#include <utility>

#include "shelfbeam/placement/problem/checker.hpp"

namespace shelfbeam {

namespace {

constexpr std::size_t rows_at_once = 16;

std::uint32_t strongest_of(const SignalTable& table, std::uint32_t row) {
  const auto entries = table.row(row);
  const auto best = std::max_element(entries.begin(), entries.end(),
                                     [](const auto& a, const auto& b) { return a.signal < b.signal; });
  return best == entries.end() ? std::numeric_limits<std::uint32_t>::max() : best->transceiver;
}

// The first of an order, spread over the shop: one a strongest unit.
std::vector<std::uint32_t> spread(const SignalTable& table,
                                  std::vector<std::pair<double, std::uint32_t>> order) {
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> rows;
  std::set<std::uint32_t> seen;
  for (const auto& [worth, row] : order) {
    if (rows.size() == rows_at_once) break;
    if (seen.insert(strongest_of(table, row)).second) rows.push_back(row);
  }
  return rows;
}

// What so many units could give at most, as parts of the requirement.
double most_of(const SignalTable& table, const Question& question, std::uint32_t row, std::size_t units) {
  std::vector<double> signals;
  for (const SignalEntry& entry : table.row(row)) signals.push_back(entry.signal);
  const std::size_t count = std::min(units, signals.size());
  std::partial_sort(signals.begin(), signals.begin() + static_cast<std::ptrdiff_t>(count), signals.end(),
                    std::greater<>());
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) sum += signals[k];
  return sum / requirement_of(table.labels[row], question.model);
}

}  // namespace

SignalTable table_of_rows(const SignalTable& table, const std::vector<std::uint32_t>& rows) {
  SignalTable part;
  part.transceivers = table.transceivers;
  part.mounts = table.mounts;
  part.apart = table.apart;
  part.row_begin = {0};
  for (const std::uint32_t i : rows) {
    part.labels.push_back(table.labels[i]);
    const auto row = table.row(i);
    part.entries.insert(part.entries.end(), row.begin(), row.end());
    part.row_begin.push_back(part.entries.size());
  }
  return part;
}

DecisiveRows decisive_rows(const SignalTable& table, const Question& question, std::size_t count,
                           const PlaceOptions& wanted, const RunControl& control) {
  const auto begin = std::chrono::steady_clock::now();
  const auto left = [&] {
    return wanted.time_limit_s -
           std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  std::vector<std::pair<double, std::uint32_t>> order;
  for (std::uint32_t i = 0; i < table.rows(); ++i)
    order.emplace_back(most_of(table, question, i, std::max<std::size_t>(count, 2) - 1), i);
  DecisiveRows decisive;
  decisive.rows = spread(table, std::move(order));
  std::sort(decisive.rows.begin(), decisive.rows.end());
  PlaceOptions options = wanted;
  while ((options.step_limit || left() > 0) && !control.cancelled()) {
    options.time_limit_s = left();
    options.settles_ties = false;
    const Placement answer = place(table_of_rows(table, decisive.rows), question, options, control);
    decisive.suffice = answer.count_lower_bound >= static_cast<double>(count);
    if (decisive.suffice || !answer.has_selection() || answer.count() >= count) break;
    const Check check = check_selection(table, question, answer.selected);
    order.clear();
    for (const std::uint32_t i : check.unmet)
      order.emplace_back(check.signal[i] / requirement_of(table.labels[i], question.model), i);
    if (order.empty()) break;
    for (const std::uint32_t row : spread(table, std::move(order))) decisive.rows.push_back(row);
    std::sort(decisive.rows.begin(), decisive.rows.end());
  }
  return decisive;
}

}  // namespace shelfbeam
