#include "shelfbeam/placement/coverage/coverage_proof.hpp"

#include <algorithm>
#include <bit>
#include <functional>
#include <stdexcept>
#include <utility>

#include "shelfbeam/math/order.hpp"
#include "shelfbeam/placement/kernels/search_matrix.hpp"
#include "shelfbeam/placement/problem/label_shares.hpp"

namespace shelfbeam::detail {

namespace {

// Allowances for rounding in sums, far above the actual error, and for sums in another order.
constexpr double judge_slack = 1e-10, judge_tie = 1e-12;

class Judge {
 public:
  Judge(const Instance& instance, const LabelWeights& weights, const CoverageProof& proof, std::size_t units,
        double needed, const Effort& effort, const RunControl& control)
      : instance_(instance),
        weights_(weights),
        proof_(proof),
        units_(units),
        needed_(needed),
        effort_(effort),
        control_(control),
        is_sum_(instance.is_cooperative()),
        omits_best_(is_sum_ && instance.problem.redundant),
        target_(is_sum_                      ? 1 - met_tolerance - judge_tie
                : instance.problem.redundant ? 2
                                             : 1),
        // The search's target, which is below the exact rule: near-ties count as in the search.
        relaxed_target_(is_sum_ ? static_cast<double>(static_cast<float>(1 - search_tolerance)) : target_),
        column_(instance.columns()),
        chosen_(marked(instance.columns(), instance.installed)) {
    for (const std::vector<float>& y : proof.multipliers)
      if (y.size() != proof.rows.size() ||
          !std::all_of(y.begin(), y.end(), [](float one) { return one >= 0 && one <= 1; }))
        throw std::out_of_range("multipliers are out of range");
  }

  ProofVerdict judge() {
    if (instance_.installed.size() > units_) return ProofVerdict::holds;
    fill();
    const auto all = numbers_where<ColumnId>(instance_.available);
    const bool holds = node(states_.front(), all, free_) && at_ == proof_.steps.size();
    return is_refuted_ ? ProofVerdict::refuted
           : holds     ? ProofVerdict::holds
           : ran_out_  ? ProofVerdict::unfinished
                       : ProofVerdict::unconfirmed;
  }

 private:
  struct Entry {
    std::uint32_t row = 0;
    double share = 0;
  };
  /// The labels as the chosen units leave them.
  struct State {
    std::vector<double> value, best;  ///< signal by the rule, and the strongest if the rule omits it
    std::vector<double> lack;         ///< 0: reached
    std::vector<double> weight;       ///< of the labels that are neither reached nor out of reach
    double reached = 0;               ///< weight, by the checker's rule
    double nearly_reached = 0, within_reach = 0;  ///< by the target of the search
  };
  /// sum_i w_i (1 - y_i) and v_j.
  struct Values {
    double fixed = 0;
    std::vector<double> of_column;
  };

  // Labels that further units may reach become rows, in the order of the proof; others count at once.
  void fill() {
    std::vector<std::uint32_t> place(instance_.rows(), CoverageProof::end);  // of a label among the rows
    std::vector<bool> helps(instance_.columns(), false);
    for (std::uint32_t r = 0; r < proof_.rows.size(); ++r) {
      place.at(proof_.rows[r]) = r;
      for (const SignalEntry& entry : instance_.row(proof_.rows[r]))
        helps[entry.transceiver] = instance_.available[entry.transceiver];
    }
    const auto candidates = static_cast<std::size_t>(std::count(helps.begin(), helps.end(), true));
    free_ = std::min(units_ - instance_.installed.size(), candidates);
    states_.resize(free_ + 1);
    State& root = states_.front();
    root.value = root.best = std::vector<double>(proof_.rows.size());
    strongest_.assign(free_ + 1, root.value);
    for (std::uint32_t i = 0; i < instance_.rows(); ++i) {
      const std::uint32_t r = place[i];
      std::vector<double> shares;
      for (const SignalEntry& entry : instance_.row(i)) {
        const double share = share_of(entry.signal, instance_.requirement(i), instance_.problem);
        if (r != CoverageProof::end && share > 0) column_[entry.transceiver].push_back({r, share});
        if (instance_.available[entry.transceiver]) shares.push_back(share);
      }
      std::sort(shares.begin(), shares.end(), std::greater<>());
      if (r == CoverageProof::end) {
        settle(i);
        continue;
      }
      for (std::size_t k = 1; k <= free_; ++k)
        strongest_[k][r] = strongest_[k - 1][r] + (k <= shares.size() ? shares[k - 1] : 0);
    }
    for (const ColumnId j : instance_.installed) receive(root, j);
  }

  // A label without a row is reached by the installed units, or by no selection.
  void settle(LabelId label) {
    if (instance_.is_reached(label, chosen_))
      settled_ += weights_[label];
    else if (weights_[label] > 0 &&
             instance_.mounts.may_meet(instance_.row(label), instance_.requirement(label), instance_.problem))
      throw std::out_of_range("a label has no row");
  }

  double after(const State& state, std::uint32_t r, double share) const {
    return state.value[r] + (omits_best_ ? std::min(state.best[r], share) : share);
  }
  void receive(State& state, ColumnId j) const {
    for (const Entry& entry : column_[j]) {
      state.value[entry.row] = after(state, entry.row, entry.share);
      state.best[entry.row] = std::max(state.best[entry.row], entry.share);
    }
  }

  // Near-ties are decided by the checker's rule.
  bool is_reached(std::uint32_t r, double value) const {
    const double surely = is_sum_ ? target_ + 2 * judge_tie : target_;
    return value >= target_ && (value >= surely || instance_.is_reached(proof_.rows[r], chosen_));
  }

  // With unit failure, the signals of at most K units add up to at least K / (K - 1) of the target.
  void measure(State& state, std::size_t free) const {
    const auto units = static_cast<double>(instance_.installed.size() + free_);
    const double together = relaxed_target_ * (omits_best_ ? units / (units - 1) : 1);
    state.lack.assign(proof_.rows.size(), 0);
    state.weight.assign(proof_.rows.size(), 0);
    state.reached = state.nearly_reached = state.within_reach = settled_;
    for (std::uint32_t r = 0; r < proof_.rows.size(); ++r) {
      const double weight = weights_[proof_.rows[r]];
      if (is_reached(r, state.value[r])) state.reached += weight;
      const double need = relaxed_target_ - state.value[r];
      if (need <= 0) {
        state.nearly_reached += weight;
        state.within_reach += weight;
        continue;
      }
      const double lack = omits_best_ ? std::max(need, together - state.value[r] - state.best[r]) : need;
      state.lack[r] = lack;
      if (strongest_[free][r] * (1 + judge_slack) < lack) continue;
      state.weight[r] = weight;
      state.within_reach += weight;
    }
  }

  bool is_useless(const std::vector<ColumnId>& list) const {
    return std::all_of(list.begin(), list.end(), [&](ColumnId j) { return column_[j].empty(); });
  }

  bool is_less(double bound) const { return bound * (1 + judge_slack) < needed_; }

  std::uint32_t next() { return proof_.steps.at(at_++); }

  // Reads the steps of one node; true if they prove it.
  bool node(State& state, const std::vector<ColumnId>& list, std::size_t free) {
    ran_out_ = ran_out_ || work_ >= effort_.steps || effort_.is_over(control_);
    measure(state, free);
    is_refuted_ = is_refuted_ || state.reached >= needed_;
    if (ran_out_ || is_refuted_) return false;
    switch (next()) {
      case CoverageProof::nothing_left:
        return free == 0 || is_useless(list);
      case CoverageProof::out_of_reach:
        return is_less(state.within_reach);
      case CoverageProof::single_fails:
        return free == 1 && every_single_fails(state, list);
      case CoverageProof::bound_fails: {
        const Values values = read_values(state, list, free);
        return is_less(values.fixed + largest(values, list, free));
      }
      case CoverageProof::branch:
        return branch(state, list, free);
      default:
        return false;
    }
  }

  bool every_single_fails(const State& state, const std::vector<ColumnId>& list) {
    for (const ColumnId j : list) {
      work_ += column_[j].size() + 1;
      double reached = state.reached;
      for (const Entry& entry : column_[j])
        if (!is_reached(entry.row, state.value[entry.row])) {
          chosen_[j] = true;
          if (is_reached(entry.row, after(state, entry.row, entry.share)))
            reached += weights_[proof_.rows[entry.row]];
          chosen_[j] = false;
        }
      is_refuted_ = is_refuted_ || reached >= needed_;
    }
    return !is_refuted_;
  }

  Values read_values(const State& state, const std::vector<ColumnId>& list, std::size_t free) {
    const auto omitted = static_cast<double>(std::bit_cast<float>(next()));
    const std::vector<float>& y = proof_.multipliers.at(next());
    if (!(omitted >= 0 && omitted < 1) || free == 0) throw std::out_of_range("a part is out of range");
    Values values{state.nearly_reached, std::vector<double>(instance_.columns(), 0)};
    for (std::uint32_t r = 0; r < y.size(); ++r)
      values.fixed += state.weight[r] * (1 - static_cast<double>(y[r]));
    for (const ColumnId j : list) {
      work_ += column_[j].size() + 1;
      for (const Entry& entry : column_[j]) {
        const std::uint32_t r = entry.row;
        if (state.weight[r] == 0) continue;
        const double shift = omitted * state.lack[r] / static_cast<double>(free);
        const double share = std::max(0.0, entry.share - shift) / ((1 - omitted) * state.lack[r]);
        values.of_column[j] += state.weight[r] * static_cast<double>(y[r]) * std::min(1.0, share);
      }
    }
    return values;
  }

  // The sum of the `count` largest values of different mounting points.
  double largest(const Values& values, std::vector<ColumnId> list, std::size_t count) const {
    std::ranges::sort(list, std::greater{}, [&](ColumnId j) { return values.of_column[j]; });
    std::vector<std::uint32_t> points;
    double sum = 0;
    for (const ColumnId j : list) {
      if (points.size() == count) break;
      const std::uint32_t point = instance_.mounts.first_option(j);
      if (std::find(points.begin(), points.end(), point) != points.end()) continue;
      points.push_back(point);
      sum += values.of_column[j];
    }
    return sum;
  }

  // Reads a node without verification.
  void skip() {
    const std::uint32_t tag = next();
    if (tag == CoverageProof::bound_fails || tag == CoverageProof::branch) next(), next();
    if (tag == CoverageProof::branch)
      while (next() != CoverageProof::end) skip();
  }

  bool branch(const State& state, std::vector<ColumnId> list, std::size_t free) {
    if (free < 2) return false;
    const Values values = read_values(state, list, free);
    for (std::uint32_t j = next(); j != CoverageProof::end; j = next()) {
      if (std::erase(list, ColumnId(j)) == 0) {  // ruled out here, by less rounding
        skip();
        continue;
      }
      const double with_best = values.fixed + values.of_column[j] + largest(values, list, free - 2);
      std::vector<ColumnId> others = list;
      for (const ColumnId other : instance_.excludes[j]) std::erase(others, other);
      std::erase_if(others, [&](ColumnId other) { return is_less(with_best + values.of_column[other]); });
      State& child = states_[free_ - free + 1];
      child.value = state.value;
      child.best = state.best;
      chosen_[j] = true;
      receive(child, j);
      const bool is_proven = node(child, others, free - 1);
      chosen_[j] = false;
      if (!is_proven) return false;
    }
    return is_useless(list) || is_less(values.fixed + largest(values, std::move(list), free));
  }

  const Instance& instance_;
  const LabelWeights& weights_;
  const CoverageProof& proof_;
  std::size_t units_;
  double needed_;
  const Effort& effort_;
  const RunControl& control_;
  bool is_sum_, omits_best_, ran_out_ = false, is_refuted_ = false;
  double target_, relaxed_target_, settled_ = 0;
  std::size_t free_ = 0, at_ = 0;
  std::uint64_t work_ = 0;                      ///< entries examined
  std::vector<std::vector<Entry>> column_;      ///< by column of the table
  std::vector<bool> chosen_;                    ///< by column of the table
  std::vector<std::vector<double>> strongest_;  ///< per number of units: the sum of a row's strongest shares
  std::vector<State> states_;                   ///< per depth
};

}  // namespace

ProofVerdict judge_coverage(const Instance& instance, const LabelWeights& weights, const CoverageProof& proof,
                            std::size_t units, double needed, const Effort& effort,
                            const RunControl& control) {
  try {
    const Instance own(instance.table, instance.problem);
    return Judge(own, weights, proof, units, needed, effort, control).judge();
  } catch (const std::out_of_range&) {
    return ProofVerdict::refuted;
  }
}

std::optional<BoundProof> judged(const Instance& instance, const LabelWeights& weights,
                                 const CoverageProof& proof, std::size_t units, double needed,
                                 const Effort& effort, const RunControl& control) {
  constexpr std::uint64_t max_work = 5'000'000'000;  // some seconds
  if (proof.steps.empty()) return BoundProof::search;
  return strength_of(
      judge_coverage(instance, weights, proof, units, needed, {max_work, effort.until}, control));
}

}  // namespace shelfbeam::detail
