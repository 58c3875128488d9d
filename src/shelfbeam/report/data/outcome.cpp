#include "shelfbeam/report/data/outcome.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shelfbeam/math/order.hpp"
#include "shelfbeam/placement/problem/mounts.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam {

namespace {

std::vector<SignalEntry> entries_of(const SignalMatrix& matrix, std::size_t label) {
  std::vector<SignalEntry> entries;
  for (std::uint32_t j = 0; j < matrix.columns(); ++j) entries.push_back({j, matrix.signal(label, j)});
  return entries;
}

// The label is not met without its flagged entries, and those of the chosen units exceed a small share of its
// requirement.
bool depends_on_flagged(const SignalMatrix& matrix, const Placement& placement,
                        const std::vector<bool>& chosen, std::size_t label) {
  constexpr double min_flagged_share = 0.02;
  const double requirement = matrix.labels[label].requirement;
  const auto is_flagged = [&](std::uint32_t column) { return matrix.is_flagged(matrix.at(label, column)); };
  double flagged = 0;
  for (const std::uint32_t column : placement.selected)
    if (is_flagged(column)) flagged += matrix.signal(label, column);
  if (!(flagged > min_flagged_share * requirement)) return false;
  std::vector<SignalEntry> entries = entries_of(matrix, label);
  std::erase_if(entries, [&](const SignalEntry& entry) { return is_flagged(entry.transceiver); });
  return !is_met(received_signal(entries, chosen, placement.problem), requirement);
}

LabelOutcome label_outcome(const SignalMatrix& matrix, const Placement& placement, const Mounts& mounts,
                           const std::vector<bool>& chosen, std::size_t label) {
  const PlacementProblem& problem = placement.problem;
  const auto row = matrix.mean_row(label);
  const auto direct = [&](std::uint32_t column) {
    return matrix.direct.empty() ? 0.0 : static_cast<double>(matrix.direct[matrix.at(label, column)]);
  };
  LabelOutcome result;
  result.requirement = matrix.labels[label].requirement;
  double strongest_signal = 0;
  std::optional<std::uint32_t> second;
  for (const std::uint32_t column : placement.selected) {
    const auto signal = static_cast<double>(row[column]);
    if (is_met(signal, result.requirement)) result.reached_by.push_back(column);
    result.direct += direct(column);
    if (signal > strongest_signal) {
      second = result.strongest;
      result.strongest = column;
      strongest_signal = signal;
    } else if (signal > 0 && (!second || signal > static_cast<double>(row[*second]))) {
      second = column;
    }
  }
  const std::optional<std::uint32_t> counting = problem.redundant ? second : result.strongest;
  if (problem.model == CommunicationModel::non_cooperative)
    result.direct = counting ? direct(*counting) : 0;
  else if (problem.redundant && result.strongest)
    result.direct -= direct(*result.strongest);
  const std::vector<SignalEntry> entries = entries_of(matrix, label);
  result.signal = received_signal(entries, chosen, problem);
  result.best = mounts.max_signal(entries, problem);
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

std::vector<LabelId> Outcome::served_by(std::size_t k) const {
  const UnitOutcome& unit = units[k];
  std::vector<LabelId> served;
  for (std::uint32_t i = 0; i < labels.size(); ++i) {
    const auto& alone = labels[i].reached_by;
    const bool serves = unit.reaches_alone > 0
                            ? std::find(alone.begin(), alone.end(), unit.column) != alone.end()
                            : labels[i].strongest == unit.column;
    if (serves) served.push_back(i);
  }
  return served;
}

Outcome outcome_of(const SignalMatrix& matrix, const Placement& placement,
                   const std::optional<Certificate>& certificate) {
  Outcome outcome;
  for (const std::uint32_t column : placement.selected) outcome.units.push_back({column, 0, 0, 0});
  const Mounts mounts(shared_mounts(matrix), matrix.transceivers);
  std::vector<bool> chosen = marked(matrix.columns(), placement.selected);
  // A unit is needed where its failure alone leaves the label unmet; a redundant placement has no such unit.
  PlacementProblem nothing_fails = placement.problem;
  nothing_fails.redundant = false;
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    LabelOutcome label = label_outcome(matrix, placement, mounts, chosen, i);
    const bool has_verdict = certificate && is_decided(certificate->labels[i].verdict);
    label.depends_on_flagged = !has_verdict && depends_on_flagged(matrix, placement, chosen, i);
    const std::vector<SignalEntry> entries = entries_of(matrix, i);
    if (label.met) ++outcome.met;
    if (label.depends_on_flagged) ++outcome.flagged_labels;
    if (label.reached_by.size() > 1) ++outcome.redundant;
    if (label.met && is_met(label.direct, label.requirement)) ++outcome.met_by_direct_light;
    bool depends_on_one = false;
    for (UnitOutcome& unit : outcome.units) {
      if (is_met(matrix.signal(i, unit.column), label.requirement)) ++unit.reaches_alone;
      if (label.strongest == unit.column) ++unit.strongest_for;
      chosen[unit.column] = false;
      if (label.met && !is_met(received_signal(entries, chosen, nothing_fails), label.requirement)) {
        ++unit.needed_by;
        depends_on_one = true;
      }
      chosen[unit.column] = true;
    }
    if (label.met && !depends_on_one) ++outcome.secure;
    outcome.labels.push_back(std::move(label));
  }
  outcome.by_margin =
      ordered_by<LabelId>(matrix.rows(), [&](LabelId i) { return outcome.labels[i].margin(); });
  return outcome;
}

}  // namespace shelfbeam
