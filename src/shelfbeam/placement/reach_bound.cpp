#include "shelfbeam/placement/reach_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace shelfbeam {

namespace {

float rounded_up(double value) {
  return std::nextafter(static_cast<float>(value), std::numeric_limits<float>::infinity());
}

}  // namespace

ReachBound::ReachBound(const SignalTable& table, const Question& question, std::size_t most_units)
    : mounts_(table), installed_(table.columns(), false), redundant_(question.redundant) {
  for (std::size_t j = 0; j < table.columns(); ++j)
    if (table.transceivers[j].installed) installed_[j] = true, ++installed_count_;
  const bool cooperative = question.model == CommunicationModel::cooperative;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const auto row = table.row(i);
    const double requirement = requirement_of(table.labels[i], question.model);
    if (!is_met(mounts_.most_signal(row, question) * (1 + 1e-12), requirement)) continue;
    // What the shares of a met label add up to; as for CoverModel's rows where one of k units may fail.
    double together = 1;
    if (redundant_) {
      const auto units = static_cast<double>(std::max<std::size_t>(2, std::min(most_units, row.size())));
      together = cooperative ? units / (units - 1) : 2;
    }
    const double enough = requirement * (1 - 2 * met_tolerance);
    for (const SignalEntry& entry : row) {
      if (!mounts_.available(entry.transceiver)) continue;
      if (!cooperative && !is_met(entry.signal, requirement)) continue;
      const double share = cooperative ? std::min(1.0, entry.signal / enough) : 1;
      entries_.push_back({entry.transceiver, rounded_up(share / together)});
    }
    row_begin_.push_back(entries_.size());
  }
  multiplier_.assign(row_begin_.size() - 1, 1.0);
  best_.assign(most_units + 1, static_cast<double>(multiplier_.size()));
}

std::size_t ReachBound::labels(std::size_t units) const {
  const std::size_t all = multiplier_.size();
  if (redundant_ && units < 2) return 0;
  // Sums of m terms are off by less than m 1e-16 of themselves.
  return std::min(all, static_cast<std::size_t>(std::floor(best_[units] * (1 + 1e-9) + 1e-9)));
}

// The best candidate of every mounting point, best first; installed units are not among them.
std::vector<ReachBound::Candidate> ReachBound::best_candidates(const std::vector<double>& value) const {
  std::vector<Candidate> candidates;
  for (std::uint32_t j = 0; j < value.size(); ++j) {
    if (installed_[j] || !mounts_.available(j)) continue;
    const auto options = mounts_.options(j);
    const bool beaten = std::any_of(options.begin(), options.end(), [&](std::uint32_t other) {
      return value[other] > value[j] || (value[other] == value[j] && other < j);
    });
    if (!beaten) candidates.push_back({j, value[j]});
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.value > b.value; });
  return candidates;
}

// Takes the bounds of the multipliers for every number of units; returns the one for `units` and the units
// that it counts.
double ReachBound::evaluate(std::size_t units, std::vector<bool>& counted) {
  std::vector<double> value(installed_.size(), 0.0);
  double sum = 0;
  for (std::size_t i = 0; i < multiplier_.size(); ++i) {
    const double y = multiplier_[i];
    sum += 1 - y;
    if (y == 0) continue;
    for (std::size_t k = row_begin_[i]; k < row_begin_[i + 1]; ++k)
      value[entries_[k].column] += y * static_cast<double>(entries_[k].share);
  }
  counted = installed_;
  for (std::size_t j = 0; j < value.size(); ++j)
    if (installed_[j]) sum += value[j];
  const std::vector<Candidate> candidates = best_candidates(value);
  double wanted = sum;
  for (std::size_t k = installed_count_; k < best_.size(); ++k) {
    const std::size_t next = k - installed_count_;
    if (next > 0 && next <= candidates.size()) {
      sum += candidates[next - 1].value;
      if (k <= units) counted[candidates[next - 1].column] = true;
    }
    best_[k] = std::min(best_[k], sum);
    if (k == units) wanted = sum;
  }
  return wanted;
}

void ReachBound::improve(std::size_t units, std::size_t reached, std::size_t steps,
                         const RunControl& control) {
  double length = 1;
  double least = std::numeric_limits<double>::infinity();
  std::size_t since_better = 0;
  std::vector<double> best_multiplier = multiplier_;
  std::vector<bool> counted;
  std::vector<double> excess(multiplier_.size());
  for (std::size_t step = 0; step < steps && !control.cancelled(); ++step) {
    const double value = evaluate(units, counted);
    if (labels(units) <= reached) return;
    if (value < least * (1 - 1e-6)) {
      since_better = 0;
    } else if (++since_better >= 10) {
      length *= 0.5;
      since_better = 0;
      multiplier_ = best_multiplier;
      if (length < 1e-4) return;
      continue;
    }
    if (value < least) {
      least = value;
      best_multiplier = multiplier_;
    }
    // A subgradient: what the counted units give to a label beyond its share. Polyak's step towards what is
    // known to be possible.
    double norm = 0;
    for (std::size_t i = 0; i < excess.size(); ++i) {
      excess[i] = -1;
      for (std::size_t k = row_begin_[i]; k < row_begin_[i + 1]; ++k)
        if (counted[entries_[k].column]) excess[i] += static_cast<double>(entries_[k].share);
      const bool stays = (multiplier_[i] >= 1 && excess[i] < 0) || (multiplier_[i] <= 0 && excess[i] > 0);
      if (!stays) norm += excess[i] * excess[i];
    }
    if (norm == 0) return;  // nothing is better for this number of units
    const double move = length * std::max(0.5, value - static_cast<double>(reached)) / norm;
    for (std::size_t i = 0; i < excess.size(); ++i)
      multiplier_[i] = std::clamp(multiplier_[i] - move * excess[i], 0.0, 1.0);
  }
  multiplier_ = best_multiplier;
}

}  // namespace shelfbeam
