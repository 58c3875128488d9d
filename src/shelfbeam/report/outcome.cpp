#include "shelfbeam/report/outcome.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "shelfbeam/placement/mounts.hpp"
#include "shelfbeam/signal/signal_table.hpp"

namespace shelfbeam {

namespace {

// What is left of a label's signal without the chosen unit at `left_out`.
double signal_without(const SignalMatrix& matrix, const Placement& placement, std::size_t label,
                      std::uint32_t left_out) {
  const auto row = matrix.mean_row(label);
  double sum = 0, largest = 0;
  for (const std::uint32_t column : placement.selected) {
    if (column == left_out) continue;
    sum += static_cast<double>(row[column]);
    largest = std::max(largest, static_cast<double>(row[column]));
  }
  return placement.question.model == CommunicationModel::cooperative ? sum : largest;
}

LabelOutcome label_outcome(const SignalMatrix& matrix, const Placement& placement, const Mounts& mounts,
                           std::size_t label) {
  const bool adds_up = placement.question.model == CommunicationModel::cooperative;
  const auto row = matrix.mean_row(label);
  const auto direct = [&](std::uint32_t column) {
    return matrix.direct.empty() ? 0.0 : static_cast<double>(matrix.direct[matrix.at(label, column)]);
  };
  LabelOutcome result;
  result.requirement = matrix.labels[label].requirement;
  for (const std::uint32_t column : placement.selected) {
    const auto signal = static_cast<double>(row[column]);
    if (signal > result.strongest_signal) {
      result.strongest = column;
      result.strongest_signal = signal;
    }
    if (is_met(signal, result.requirement)) result.reached_by.push_back(column);
    if (adds_up) {
      result.signal += signal;
      result.direct += direct(column);
    }
  }
  if (!adds_up) {
    result.signal = result.strongest_signal;
    if (result.strongest) result.direct = direct(*result.strongest);
  }
  std::vector<SignalEntry> entries;
  for (std::uint32_t j = 0; j < row.size(); ++j) entries.push_back({j, static_cast<double>(row[j])});
  result.best = mounts.most_signal(entries, placement.question.model);
  result.met = !placement.selected.empty() && is_met(result.signal, result.requirement);
  return result;
}

}  // namespace

double margin_db(double signal, double requirement) {
  if (requirement <= 0) return std::numeric_limits<double>::infinity();
  return 10 * std::log10(signal / requirement);
}

std::vector<double> Outcome::direct_shares() const {
  std::vector<double> shares;
  for (const LabelOutcome& label : labels)
    if (label.signal > 0) shares.push_back(label.direct / label.signal);
  return shares;
}

std::vector<std::uint32_t> Outcome::served_by(std::size_t k) const {
  const UnitOutcome& unit = units[k];
  std::vector<std::uint32_t> served;
  for (std::uint32_t i = 0; i < labels.size(); ++i) {
    const auto& alone = labels[i].reached_by;
    const bool serves = unit.reaches_alone > 0
                            ? std::find(alone.begin(), alone.end(), unit.column) != alone.end()
                            : labels[i].strongest == unit.column;
    if (serves) served.push_back(i);
  }
  return served;
}

Outcome outcome_of(const SignalMatrix& matrix, const Placement& placement) {
  Outcome outcome;
  for (const std::uint32_t column : placement.selected) outcome.units.push_back({column, 0, 0, 0});
  const Mounts mounts(shared_mounts(matrix), matrix.transceivers);
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    LabelOutcome label = label_outcome(matrix, placement, mounts, i);
    if (label.met) ++outcome.met;
    if (label.reached_by.size() > 1) ++outcome.redundant;
    if (label.met && is_met(label.direct, label.requirement)) ++outcome.met_by_direct;
    for (UnitOutcome& unit : outcome.units) {
      if (is_met(static_cast<double>(matrix.mean[matrix.at(i, unit.column)]), label.requirement))
        ++unit.reaches_alone;
      if (label.strongest == unit.column) ++unit.strongest_for;
      if (label.met && !is_met(signal_without(matrix, placement, i, unit.column), label.requirement))
        ++unit.needed_by;
    }
    outcome.labels.push_back(std::move(label));
  }
  outcome.by_margin.resize(matrix.rows());
  std::iota(outcome.by_margin.begin(), outcome.by_margin.end(), 0U);
  std::stable_sort(outcome.by_margin.begin(), outcome.by_margin.end(),
                   [&](auto a, auto b) { return outcome.labels[a].margin() < outcome.labels[b].margin(); });
  return outcome;
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const double place = q * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(place);
  const std::size_t high = std::min(low + 1, values.size() - 1);
  return values[low] + (place - static_cast<double>(low)) * (values[high] - values[low]);
}

}  // namespace shelfbeam
