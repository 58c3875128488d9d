#include "shelfbeam/placement/coverage/coverage_bound.hpp"

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

CoverageBound::CoverageBound(const SignalTable& table, const PlacementProblem& problem,
                             const detail::LabelWeights& weights, std::size_t max_units)
    : weights_(weights), mounts_(table), installed_(table.columns(), false), redundant_(problem.redundant) {
  for (std::size_t j = 0; j < table.columns(); ++j)
    if (table.transceivers[j].installed) installed_[j] = true, ++installed_count_;
  const bool cooperative = problem.model == CommunicationModel::cooperative;
  double all = 0;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    if (weights[i] <= 0) continue;
    const auto row = table.row(i);
    const double requirement = requirement_of(table.labels[i], problem.model);
    if (!is_met(mounts_.max_signal(row, problem) * (1 + 1e-12), requirement)) continue;
    // R_i: the shares of a reached label add up to at least this.
    double together = 1;
    if (redundant_) {
      const auto units = static_cast<double>(std::max<std::size_t>(2, std::min(max_units, row.size())));
      together = cooperative ? units / (units - 1) : 2;
    }
    const double enough = requirement * (1 - 2 * met_tolerance);
    for (const SignalEntry& entry : row) {
      if (!mounts_.available(entry.transceiver)) continue;
      if (!cooperative && !is_met(entry.signal, requirement)) continue;
      const double share = cooperative ? std::min(1.0, entry.signal / enough) : 1;
      entries_.push_back({entry.transceiver, rounded_up(share)});
    }
    row_begin_.push_back(entries_.size());
    min_share_sum_.push_back(together);
    weight_.push_back(weights[i]);
    all += weights[i];
  }
  const std::vector<double> ones(min_share_sum_.size(), 1.0);
  for (const double omitted : {0.0, 0.3, 0.6, 0.95})
    if (omitted == 0 || cooperative) kinds_.push_back({omitted, ones});
  best_.assign(max_units + 1, all);
}

double CoverageBound::weight(std::size_t units) const {
  if (units < (redundant_ ? 2U : 1U)) return 0;
  // The relative error of sums of m terms is below 1e-16 m.
  return weights_.rounded_down(best_[units]);
}

// The best candidate of every mounting point, without installed units, in descending order.
std::vector<CoverageBound::Candidate> CoverageBound::best_candidates(const std::vector<double>& value) const {
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

// b_ij of the coverage bound, with R_i in `min_share_sum_` and k d in `omitted`:
//
//   b_ij = min(1, max(0, a_ij - d) / (R_i - k d)).
//
// At most k units of a reached label satisfy sum_j (a_ij - d) T_j >= R_i - k d > 0, so the b_ij add up to at
// least 1.
inline double CoverageBound::lifted(const Kind& kind, std::size_t units, std::size_t label,
                                    const Entry& entry) const {
  const double less = kind.omitted / static_cast<double>(units);
  return std::clamp((static_cast<double>(entry.share) - less) / (min_share_sum_[label] - kind.omitted), 0.0,
                    1.0);
}

// Updates the bounds of all numbers of units for which the multipliers are valid: all if d = 0, otherwise up
// to `units`. Returns the bound for `units` and the units counted in it.
double CoverageBound::evaluate(const Kind& kind, std::size_t units, std::vector<bool>& counted) {
  std::vector<double> value(installed_.size(), 0.0);
  double sum = 0;
  for (std::size_t i = 0; i < min_share_sum_.size(); ++i) {
    const double y = kind.multiplier[i];
    sum += weight_[i] * (1 - y);
    if (y == 0) continue;
    for (std::size_t k = row_begin_[i]; k < row_begin_[i + 1]; ++k)
      value[entries_[k].column] += weight_[i] * y * lifted(kind, units, i, entries_[k]);
  }
  counted = installed_;
  for (std::size_t j = 0; j < value.size(); ++j)
    if (installed_[j]) sum += value[j];
  const std::vector<Candidate> candidates = best_candidates(value);
  const std::size_t last = kind.omitted == 0 ? best_.size() - 1 : units;
  double at_most_units = sum;
  for (std::size_t k = installed_count_; k <= last; ++k) {
    const std::size_t next = k - installed_count_;
    if (next > 0 && next <= candidates.size()) {
      sum += candidates[next - 1].value;
      if (k <= units) counted[candidates[next - 1].column] = true;
    }
    best_[k] = std::min(best_[k], sum);
    if (k == units) at_most_units = sum;
  }
  return at_most_units;
}

void CoverageBound::improve(std::size_t units, double reached, std::size_t steps, const RunControl& control,
                            Clock::time_point until) {
  if (units == 0) return;
  const std::size_t each = (steps + kinds_.size() - 1) / kinds_.size();
  for (Kind& kind : kinds_)
    if (weight(units) > reached) improve(kind, units, reached, each, control, until);
}

void CoverageBound::improve(Kind& kind, std::size_t units, double reached, std::size_t steps,
                            const RunControl& control, Clock::time_point until) {
  std::vector<double>& multiplier = kind.multiplier;
  double length = 1;
  double smallest = std::numeric_limits<double>::infinity();
  std::size_t since_better = 0;
  std::vector<double> best_multiplier = multiplier;
  std::vector<bool> counted;
  std::vector<double> excess(multiplier.size());
  for (std::size_t step = 0; step < steps && !control.cancelled() && Clock::now() < until; ++step) {
    const double value = evaluate(kind, units, counted);
    if (weight(units) <= reached) break;
    if (value < smallest * (1 - 1e-6)) {
      since_better = 0;
    } else if (++since_better >= 10) {
      length *= 0.5;
      since_better = 0;
      multiplier = best_multiplier;
      if (length < 1e-4) return;
      continue;
    }
    if (value < smallest) {
      smallest = value;
      best_multiplier = multiplier;
    }
    // Subgradient step with Polyak's length towards the best known selection:
    //
    //   e_i = (sum of b_ij over the counted units) - 1,
    //   y_i <- y_i - length max(1/2, bound - reached) e_i / sum_i w_i e_i^2, kept in [0, 1].
    //
    // The derivative by y_i is w_i e_i; measured in y_i sqrt(w_i), heavy and light labels move alike.
    double norm = 0;
    for (std::size_t i = 0; i < excess.size(); ++i) {
      excess[i] = -1;
      for (std::size_t k = row_begin_[i]; k < row_begin_[i + 1]; ++k)
        if (counted[entries_[k].column]) excess[i] += lifted(kind, units, i, entries_[k]);
      const bool stays = (multiplier[i] >= 1 && excess[i] < 0) || (multiplier[i] <= 0 && excess[i] > 0);
      if (!stays) norm += weight_[i] * excess[i] * excess[i];
    }
    if (norm == 0) return;  // optimal multipliers for this number of units
    const double move = length * std::max(0.5 * weights_.step(), value - reached) / norm;
    for (std::size_t i = 0; i < excess.size(); ++i)
      multiplier[i] = std::clamp(multiplier[i] - move * excess[i], 0.0, 1.0);
  }
  multiplier = best_multiplier;
}

}  // namespace shelfbeam
