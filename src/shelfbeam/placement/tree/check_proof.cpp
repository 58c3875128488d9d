#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "shelfbeam/math/order.hpp"
#include "shelfbeam/placement/kernels/search_matrix.hpp"
#include "shelfbeam/placement/tree/proof.hpp"

namespace shelfbeam::detail {

namespace {

// Allowance for rounding in sums, far above the actual error.
constexpr double rounding_slack = 1e-10;
// Allowance for near-ties, which sums of ratios or in another order decide differently.
constexpr double near_tie = 1e-12;
// The search's target in single precision, or lower: every signal that meets the rule is at least this large.
constexpr double relaxed_target = (1 - met_tolerance) * (1 - search_tolerance);

class ProofChecker {
 public:
  ProofChecker(const Instance& instance, const Proof& proof, const Effort& effort, const RunControl& control)
      : instance_(instance), proof_(proof), effort_(effort), control_(control) {
    is_sum_ = instance.is_cooperative();
    for (const LabelId i : proof.rows) {
      rows_.push_back(dense(known(i), 1 - met_tolerance));
      if (!is_sum_) relaxed_rows_.push_back(dense(i, relaxed_target));
    }
  }

  ProofVerdict judge() {
    if (!proof_.is_complete) return ProofVerdict::left_open;
    const bool is_proven = holds();
    if (ran_out_) return ProofVerdict::unfinished;
    if (is_proven) return ProofVerdict::holds;
    return is_open_ ? ProofVerdict::left_open : ProofVerdict::refuted;
  }

 private:
  bool holds() {
    if (proof_.max_cost < 0) return true;  // costs are not negative
    chosen_.assign(instance_.columns(), false);
    std::vector<bool> allowed = instance_.available;
    for (const ColumnId j : instance_.installed) take(j);
    if (instance_.installed.size() > proof_.max_units) return true;
    // A selection never exceeds all columns.
    const std::size_t units = std::min(proof_.max_units - instance_.installed.size(), instance_.columns());
    return node(allowed, units) && at_ == proof_.steps.size();
  }

  LabelId known(LabelId label) const {
    if (label >= instance_.rows()) throw std::out_of_range("the table has no such label");
    return label;
  }

  // Contributions of the columns to a label: shares of its requirement, or whether a column alone supplies
  // `min_share` of it.
  std::vector<double> dense(LabelId i, double min_share) const {
    std::vector<double> row(instance_.columns(), 0.0);
    const double requirement = instance_.requirement(i);
    for (const SignalEntry& entry : instance_.row(i))
      row[entry.transceiver] = is_sum_                                   ? entry.signal / requirement
                               : entry.signal >= requirement * min_share ? 1.0
                                                                         : 0.0;
    return row;
  }

  // The row's lack of `demand` (cooperative), or in units that must reach it.
  double lacking(const std::vector<double>& row, double demand = 1 - met_tolerance - near_tie) const {
    double sum = 0, best = 0;
    for (const ColumnId j : taken_) {
      sum += row[j];
      best = std::max(best, row[j]);
    }
    if (is_sum_) return std::max(0.0, demand - (instance_.problem.redundant ? sum - best : sum));
    return std::max(0.0, (instance_.problem.redundant ? 2 : 1) - sum);
  }

  void take(std::uint32_t j) {
    taken_.push_back(j);
    chosen_[j] = true;
    spent_ += instance_.cost[j];
  }
  void give_back() {
    spent_ -= instance_.cost[taken_.back()];
    chosen_[taken_.back()] = false;
    taken_.pop_back();
  }

  std::uint32_t next() { return proof_.steps.at(at_++); }

  struct Sums {
    double largest = 0, without_one = 0;
  };
  static Sums largest(const std::vector<double>& value, const std::vector<bool>& allowed, std::size_t count) {
    std::vector<double> positive;
    for (std::size_t j = 0; j < value.size(); ++j)
      if (allowed[j] && value[j] > 0) positive.push_back(value[j]);
    const std::size_t largest = std::min(count, positive.size());
    std::ranges::partial_sort(positive, positive.begin() + static_cast<std::ptrdiff_t>(largest),
                              std::greater{});
    Sums sums;
    for (std::size_t k = 0; k < largest; ++k) {
      sums.largest += positive[k];
      if (k + 1 < count) sums.without_one += positive[k];
    }
    return sums;
  }

  // Reads the steps of one node; true if they prove that the node is infeasible.
  bool node(std::vector<bool> allowed, std::size_t units) {
    while (!is_over()) {
      for (std::size_t j = 0; j < allowed.size(); ++j)
        allowed[j] = allowed[j] && instance_.cost[j] <= proof_.max_cost - spent_;
      switch (next()) {
        case Proof::cost_fails:
          return spent_ > proof_.max_cost || taken_.size() > proof_.max_units;
        case Proof::row_fails:
          if (const LabelId row = known(next()); instance_.is_reached(row, chosen_)) return false;
          return units == 0;
        case Proof::sum_fails: {
          const Weighing w = weighing(units, allowed);
          return w.paid + largest(w.value, allowed, units).largest < w.need * (1 - rounding_slack);
        }
        case Proof::filter: {
          const Weighing w = weighing(units, allowed);
          const double others = w.paid + largest(w.value, allowed, units).without_one;
          for (std::size_t j = 0; j < allowed.size(); ++j)
            if (others + w.value[j] < w.need * (1 - rounding_slack)) allowed[j] = false;
          break;
        }
        case Proof::single_fails:
          return units == 1 && every_single_fails(allowed);
        case Proof::branch:
          return branch(std::move(allowed), units);
        case Proof::open:
          is_open_ = true;
          return false;
        default:
          return false;
      }
    }
    return false;
  }

  bool is_over() {
    constexpr std::uint64_t between_looks = 64;
    if (++looks_ % between_looks == 0) ran_out_ = ran_out_ || effort_.is_over(control_);
    return ran_out_;
  }

  struct Weighing {
    std::vector<double> value;
    double need = 0, paid = 0;
  };
  Weighing weighing(std::size_t units, const std::vector<bool>& allowed) {
    if (units == 0) throw std::out_of_range("no unit is left to weigh");
    const std::uint32_t id = next();
    const std::vector<float>& weights = proof_.weights.at(id >> 16).at(id & 0xFFFF);
    const auto price = static_cast<double>(std::bit_cast<float>(next()));
    if (!(price >= 0) || !std::isfinite(price)) throw std::out_of_range("a price is out of range");
    // Uses the search's target, which is below the exact rule: a selection that meets the exact rule meets
    // it, and near-ties count as in the search.
    const auto& rows = is_sum_ ? rows_ : relaxed_rows_;
    Weighing w{std::vector<double>(instance_.columns(), 0.0)};
    const auto columns = numbers_where<ColumnId>(allowed);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const auto weight = static_cast<double>(weights.at(r));
      if (!(weight >= 0) || !std::isfinite(weight)) throw std::out_of_range("a weight is out of range");
      const double open = lacking(rows[r], relaxed_target);
      if (open == 0) continue;
      const double shift = is_sum_ ? Proof::shift * open / static_cast<double>(units) : 0;
      const double counted = open - static_cast<double>(units) * shift;
      w.need += weight * counted;
      for (const ColumnId j : columns)
        w.value[j] += weight * std::min(counted, std::max(0.0, rows[r][j] - shift));
    }
    for (const ColumnId j : columns) w.value[j] -= price * static_cast<double>(instance_.cost[j]);
    const std::int64_t left = proof_.max_cost - spent_;
    w.paid = price > 0 && left > 0 ? price * static_cast<double>(left) : 0;
    // Such a price proves nothing, and cancellation could make it appear to.
    if (w.paid > 2 * w.need) throw std::out_of_range("a price is too high");
    return w;
  }

  bool every_single_fails(const std::vector<bool>& allowed) {
    const auto labels = all_numbers<LabelId>(instance_.rows());
    const auto is_missed = [&](LabelId i) { return !instance_.is_reached(i, chosen_); };
    if (std::ranges::none_of(labels, is_missed)) return false;  // no column is needed
    std::vector<double> open;
    for (const auto& row : rows_) open.push_back(lacking(row));
    for (const ColumnId j : numbers_where<ColumnId>(allowed)) {
      bool fails = false;
      for (std::size_t r = 0; r < rows_.size() && !fails; ++r) fails = rows_[r][j] < open[r] - rounding_slack;
      if (fails) continue;
      take(j);
      fails = std::ranges::any_of(labels, is_missed);
      give_back();
      if (!fails) return false;
    }
    return true;
  }

  bool branch(std::vector<bool> allowed, std::size_t units) {
    const LabelId label = known(next());
    const bool by_cost = next() != 0;
    const std::uint32_t count = next();
    if (units == 0 || instance_.is_reached(label, chosen_)) return false;
    const std::vector<double> row = dense(label, 1 - met_tolerance);
    const double open = lacking(row);
    const std::int64_t cost_left = proof_.max_cost - spent_;
    std::vector<bool> listed(instance_.columns(), false);
    std::vector<bool> left = allowed;
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t j = next();
      listed.at(j) = true;
      // The search may list columns that have become too expensive; their children fail at once.
      std::vector<bool> below = left;
      below[j] = false;
      for (const ColumnId other : instance_.excludes[j]) below[other] = false;
      if (chosen_[j]) return false;
      take(j);
      const bool is_proven = node(std::move(below), units - 1);
      give_back();
      if (!is_proven) return false;
      left[j] = false;
    }
    for (std::size_t j = 0; j < row.size(); ++j) {
      if (!allowed[j] || listed[j] || row[j] == 0) continue;
      const double part = !by_cost ? 1 / static_cast<double>(units)
                          : cost_left > 0
                              ? static_cast<double>(instance_.cost[j]) / static_cast<double>(cost_left)
                              : 0;
      if (row[j] >= open * part * (1 - rounding_slack)) return false;
    }
    return true;
  }

  const Instance& instance_;
  const Proof& proof_;
  const Effort& effort_;
  const RunControl& control_;
  bool is_sum_ = true, is_open_ = false, ran_out_ = false;
  std::uint64_t looks_ = 0;
  std::vector<std::vector<double>> rows_, relaxed_rows_;
  std::vector<ColumnId> taken_;
  std::vector<bool> chosen_;
  std::int64_t spent_ = 0;
  std::size_t at_ = 0;
};

}  // namespace

ProofVerdict judge_proof(const Instance& instance, const Proof& proof, const Effort& effort,
                         const RunControl& control) {
  try {
    // Costs and conflicts from the table again.
    const Instance own(instance.table, instance.problem);
    return ProofChecker(own, proof, effort, control).judge();
  } catch (const std::out_of_range&) {
    return ProofVerdict::refuted;
  }
}

}  // namespace shelfbeam::detail
