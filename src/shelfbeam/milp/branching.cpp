#include "shelfbeam/milp/branching.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/math/steps.hpp"
#include "shelfbeam/milp/backend.hpp"

namespace shelfbeam::milp {

namespace {

constexpr double integral = 1e-6;

/// Mean gains of the objective per unit of change, by column and direction. A direction that has not been
/// tried counts as the average of the other columns.
class PseudoCosts {
 public:
  explicit PseudoCosts(std::size_t columns) : down_(columns), up_(columns) {}

  void add(std::uint32_t j, double x, const Probe& probe) {
    if (std::isfinite(probe.down)) add(down_[j], all_down_, probe.down / x);
    if (std::isfinite(probe.up)) add(up_[j], all_up_, probe.up / (1 - x));
  }
  bool is_reliable(std::uint32_t j) const {
    constexpr int enough = 4;
    return down_[j].count >= enough && up_[j].count >= enough;
  }
  bool is_known(std::uint32_t j) const { return down_[j].count + up_[j].count > 0; }
  double score(std::uint32_t j, double x) const {
    return product(value(down_[j], all_down_) * x, value(up_[j], all_up_) * (1 - x));
  }
  static double product(double down, double up) {
    constexpr double min_gain = 1e-6, max_gain = 1e20;
    return std::clamp(down, min_gain, max_gain) * std::clamp(up, min_gain, max_gain);
  }

 private:
  struct Mean {
    double sum = 0;
    int count = 0;
  };
  static void add(Mean& own, Mean& all, double gain) {
    for (Mean* mean : {&own, &all}) {
      mean->sum += std::max(gain, 0.0);
      ++mean->count;
    }
  }
  static double value(const Mean& own, const Mean& all) {
    const Mean& mean = own.count > 0 ? own : all;
    return mean.count > 0 ? mean.sum / mean.count : 1;
  }

  std::vector<Mean> down_, up_;
  Mean all_down_, all_up_;
};

class Tree {
 public:
  Tree(const Model& model, const Backend& backend, const SolveOptions& options, const RunControl& control)
      : model_(model),
        options_(options),
        control_(control),
        report_(control),
        deadline_(options.time_limit_s),
        lp_(backend.lp(model.columns)),
        costs_(model.columns.size()),
        cutoff_(options.cutoff) {
    for (const Column& column : model.columns) {
      lower_.push_back(column.lower);
      upper_.push_back(column.upper);
    }
    lp_->add_rows(model.rows);
    weight_.assign(model.columns.size(), 0.0);
    for (const Row& row : model.rows)
      for (const Entry& entry : row.entries)
        weight_[entry.column] += 1e-3 * model.columns[entry.column].cost * entry.value;
  }

  Result run() {
    lp_->set_cutoff(cutoff_);
    visit(-infinity);
    if (failed_) return {};
    Result result;
    result.is_safe = true;
    result.solution = best_;
    result.primal_bound = best_.empty() ? infinity : objective(model_, best_);
    if (was_cut_) {
      result.termination = control_.cancelled() ? Termination::interrupted : Termination::limit;
      result.dual_bound = std::min({open_bound_, options_.cutoff, found_bound()});
    } else {
      result.termination = best_.empty() ? Termination::infeasible : Termination::optimal;
      result.dual_bound = found_bound();
    }
    return result;
  }

 private:
  struct Bounds {
    std::uint32_t column = 0;
    double lower = 0, upper = 1;
  };

  // Without a step, solutions just below the best one have been pruned.
  double found_bound() const {
    if (best_.empty()) return infinity;
    return options_.step > 0 ? best_value_ : std::min(best_value_, cutoff_);
  }

  bool is_over() {
    return failed_ || was_cut_ || control_.cancelled() || deadline_.has_passed() ||
           (options_.node_limit && nodes_ >= *options_.node_limit) || is_hopeless();
  }

  // At the present pace, the tree would take several times the limits. Each branch counts half of its node.
  bool is_hopeless() const {
    constexpr double trial = 0.05, patience = 3;
    const auto exceeds = [&](double used, double limit) {
      return used > trial * limit && used > patience * limit * closed_;
    };
    if (options_.node_limit &&
        exceeds(static_cast<double>(nodes_), static_cast<double>(*options_.node_limit)))
      return true;
    return options_.time_limit_s < infinity &&
           exceeds(options_.time_limit_s - deadline_.seconds_left(), options_.time_limit_s);
  }

  void set(std::uint32_t j, double lower, double upper) {
    changes_.push_back({j, lower_[j], upper_[j]});
    lower_[j] = lower;
    upper_[j] = upper;
    lp_->set_bounds(j, lower, upper);
  }

  void undo(std::size_t depth) {
    for (; changes_.size() > depth; changes_.pop_back()) {
      const Bounds& old = changes_.back();
      lower_[old.column] = old.lower;
      upper_[old.column] = old.upper;
      lp_->set_bounds(old.column, old.lower, old.upper);
    }
  }

  // The subtree stays open; `bound` is that of its parent.
  void leave_open(double bound) {
    was_cut_ = true;
    open_bound_ = std::min(open_bound_, bound);
  }

  // Explores the subtree of the present bounds. `above`: bound of the parent.
  void visit(double above) {
    const std::size_t depth = changes_.size();
    const double before = closed_, size = std::ldexp(1.0, -branches_);
    ++branches_;
    explore(above);
    --branches_;
    closed_ = before + size;
    undo(depth);
  }

  void explore(double above) {
    double bound = above;
    for (bool again = true; again;) {
      if (is_over()) return leave_open(above);
      ++nodes_;
      LpResult found = solve();
      if (found.termination == Termination::limit || found.termination == Termination::interrupted)
        return leave_open(above);
      if (found.termination == Termination::infeasible && is_empty(found)) return;
      if (found.termination != Termination::optimal) return branch_blindly(above);
      const SafeBound safe = safe_bound(model_, lower_, upper_, found.y);
      bound = std::max(bound, safe.value);
      if (bound > cutoff_) return;
      report_(best_.empty() ? infinity : best_value_, open_bound_ < infinity ? open_bound_ : bound);
      if (is_integral(found.x)) return accept(std::move(found.x), bound);
      const std::size_t changed = changes_.size();
      fix_by_reduced_costs(safe);
      const std::optional<std::uint32_t> column = choose(found, bound);
      again = !column && changes_.size() > changed;  // columns have been fixed
      if (column)
        branch(*column, bound);
      else if (!again)
        branch_blindly(bound);
    }
  }

  // Beyond the cut-off, the last multipliers may prove less than the solver claims: then the LP is solved to
  // its end.
  LpResult solve() {
    LpResult found = lp_->solve(deadline_.seconds_left(), control_);
    if (found.termination != Termination::infeasible || is_empty(found)) return found;
    lp_->set_cutoff(infinity);
    found = lp_->solve(deadline_.seconds_left(), control_);
    lp_->set_cutoff(cutoff_);
    return found;
  }

  // Without an LP: on any open column, or by the rows if all columns are fixed.
  void branch_blindly(double bound) {
    for (std::uint32_t j = 0; j < lower_.size(); ++j)
      if (lower_[j] < upper_[j]) return branch(j, bound);
    if (violation(model_, lower_) <= feasibility_tolerance) accept(lower_, -infinity);
  }

  void branch(std::uint32_t column, double bound) {
    const std::size_t depth = changes_.size();
    set(column, 1, 1);
    visit(bound);
    undo(depth);
    set(column, 0, 0);
    visit(bound);
  }

  // The bounds contain no solution of cost up to the cut-off: proven by the LP's last multipliers or by its
  // ray.
  bool is_empty(const LpResult& found) const {
    if (!found.y.empty() && safe_bound(model_, lower_, upper_, found.y).value > cutoff_) return true;
    if (found.ray.empty()) return false;
    std::vector<double> opposite;
    for (const double y : found.ray) opposite.push_back(-y);
    return safe_bound(model_, lower_, upper_, found.ray, false).value > 0 ||
           safe_bound(model_, lower_, upper_, opposite, false).value > 0;
  }

  bool is_integral(const std::vector<double>& x) const {
    return std::all_of(x.begin(), x.end(),
                       [](double value) { return std::abs(value - std::round(value)) <= integral; });
  }

  void accept(std::vector<double> x, double bound) {
    for (double& value : x) value = std::round(value);
    const double value = objective(model_, x);
    // Rounded, it may violate a row, or cost more than the bound of the node.
    if (violation(model_, x) > feasibility_tolerance) {
      failed_ = true;
      return;
    }
    const bool is_leaf = lower_ == upper_;
    if (value <= cutoff_) {
      best_value_ = value;
      best_ = std::move(x);
      constexpr double equal_values = 1e-9;
      cutoff_ = options_.step > 0 ? next_better(value, options_.step) : value * (1 - equal_values);
      lp_->set_cutoff(cutoff_);
    }
    if (bound <= cutoff_ && !is_leaf) branch_blindly(bound);  // another solution may cost less
  }

  // With the other value of column j, the objective is at least the bound of these multipliers plus |r_j|.
  void fix_by_reduced_costs(const SafeBound& safe) {
    for (std::uint32_t j = 0; j < lower_.size(); ++j) {
      if (lower_[j] == upper_[j]) continue;
      if (!(safe.value + std::abs(safe.reduced[j]) - safe.rounding > cutoff_)) continue;
      const double value = safe.reduced[j] > 0 ? 0 : 1;
      set(j, value, value);
    }
  }

  // True if the node with column j at `value` can be closed.
  bool closes(std::uint32_t j, double value) {
    const std::size_t depth = changes_.size();
    set(j, value, value);
    ++nodes_;
    const LpResult found = solve();
    const bool is_closed = (found.termination == Termination::infeasible && is_empty(found)) ||
                           (found.termination == Termination::optimal &&
                            safe_bound(model_, lower_, upper_, found.y).value > cutoff_);
    undo(depth);
    return is_closed;
  }

  // Fixes columns one value of which a probe has shown to be useless, after a proof; false if there are none.
  bool fix_by_probes(const std::vector<std::uint32_t>& columns, const std::vector<Probe>& probes,
                     double bound) {
    bool fixes = false;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const bool is_one = bound + probes[k].down > cutoff_, is_zero = bound + probes[k].up > cutoff_;
      if (!is_one && !is_zero) continue;
      const double value = is_one ? 1 : 0;
      if (!closes(columns[k], 1 - value)) continue;
      set(columns[k], value, value);
      fixes = true;
    }
    return fixes;
  }

  // The column to branch on; nothing if columns have been fixed, so that the node should be solved again.
  std::optional<std::uint32_t> choose(const LpResult& found, double bound) {
    struct Candidate {
      double score = 0;
      std::uint32_t column = 0;
    };
    std::vector<Candidate> candidates;
    for (std::uint32_t j = 0; j < found.x.size(); ++j)
      if (lower_[j] < upper_[j] && std::abs(found.x[j] - std::round(found.x[j])) > integral)
        candidates.push_back({costs_.is_known(j) ? costs_.score(j, found.x[j])
                                                 : weight_[j] * std::min(found.x[j], 1 - found.x[j]),
                              j});
    if (candidates.empty()) return std::nullopt;  // reduced costs have just fixed the fractional columns
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
    constexpr std::size_t max_probes = 8, max_looks = 24;
    std::vector<std::uint32_t> unknown;
    for (std::size_t k = 0; k < std::min(candidates.size(), max_looks) && unknown.size() < max_probes; ++k)
      if (!costs_.is_reliable(candidates[k].column)) unknown.push_back(candidates[k].column);
    Candidate best;
    best.score = -1;
    if (!unknown.empty()) {
      constexpr int pivots = 30;
      const std::vector<Probe> probes = lp_->probe(unknown, pivots);
      if (fix_by_probes(unknown, probes, bound)) return std::nullopt;
      for (std::size_t k = 0; k < unknown.size(); ++k) {
        const std::uint32_t j = unknown[k];
        costs_.add(j, found.x[j], probes[k]);
        const double score = PseudoCosts::product(probes[k].down, probes[k].up);
        if (score > best.score) best = {score, j};
      }
    }
    for (const Candidate& one : candidates)
      if (costs_.is_reliable(one.column) && costs_.score(one.column, found.x[one.column]) > best.score)
        best = {costs_.score(one.column, found.x[one.column]), one.column};
    return best.column;
  }

  const Model& model_;
  const SolveOptions& options_;
  const RunControl& control_;
  BoundReport report_;
  Deadline deadline_;
  std::unique_ptr<LpSession> lp_;
  PseudoCosts costs_;
  double cutoff_;
  std::vector<double> lower_, upper_;
  std::vector<double> weight_;   ///< cost times entries: ranks columns that have not been tried
  std::vector<Bounds> changes_;  ///< the bounds before each change on the path from the root
  std::vector<double> best_;
  double best_value_ = infinity;
  double open_bound_ = infinity;  ///< of the subtrees left open
  bool was_cut_ = false, failed_ = false;
  double closed_ = 0;  ///< share of the tree
  int branches_ = 0;   ///< above the present node
  std::uint64_t nodes_ = 0;
};

bool is_binary(const Column& column) {
  return column.integer && column.lower >= 0 && column.upper <= 1 &&
         column.lower == std::round(column.lower) && column.upper == std::round(column.upper);
}

}  // namespace

SafeBound safe_bound(const Model& model, std::span<const double> lower, std::span<const double> upper,
                     std::span<const double> y, bool with_costs) {
  double sum = 0, added = 0;
  SafeBound safe;
  std::vector<double> size(model.columns.size(), 0.0);
  for (const Column& column : model.columns) safe.reduced.push_back(with_costs ? column.cost : 0);
  for (std::size_t j = 0; j < size.size(); ++j) size[j] = std::abs(safe.reduced[j]);
  for (std::size_t i = 0; i < model.rows.size(); ++i) {
    const Row& row = model.rows[i];
    const double rhs = y[i] > 0 ? row.lower : row.upper;
    if (y[i] == 0 || !std::isfinite(y[i]) || !std::isfinite(rhs)) continue;
    sum += y[i] * rhs;
    added += std::abs(y[i] * rhs);
    for (const Entry& entry : row.entries) {
      safe.reduced[entry.column] -= y[i] * entry.value;
      size[entry.column] += std::abs(y[i] * entry.value);
    }
  }
  for (std::size_t j = 0; j < size.size(); ++j) {
    sum += std::min(safe.reduced[j] * lower[j], safe.reduced[j] * upper[j]);
    added += size[j] * std::max(std::abs(lower[j]), std::abs(upper[j]));
  }
  const auto terms = static_cast<double>(model.rows.size() + model.columns.size() + 8);
  safe.rounding = terms * std::numeric_limits<double>::epsilon() * added;
  safe.value = sum - safe.rounding;
  return safe;
}

Result branch_and_bound(const Model& model, const Backend& backend, const SolveOptions& options,
                        const RunControl& control) {
  if (!std::all_of(model.columns.begin(), model.columns.end(), is_binary)) return {};
  if (model.columns.empty()) return backend.solve(model, options, control);
  return verified(model, options, Tree(model, backend, options, control).run());
}

}  // namespace shelfbeam::milp
