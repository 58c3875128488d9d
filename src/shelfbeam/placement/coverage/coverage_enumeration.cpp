#include "shelfbeam/placement/coverage/coverage_enumeration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <span>

#include "shelfbeam/math/order.hpp"
#include "shelfbeam/placement/bound/ascent.hpp"
#include "shelfbeam/placement/kernels/coverage_kernels.hpp"

namespace shelfbeam::detail {

namespace {

constexpr std::size_t max_cells = 64'000'000;  // of the dense matrix: 256 MB
constexpr std::size_t max_free = 10;
// Signals are at most 1, so no single one supplies this lack.
constexpr float out_of_reach = 4;
// The parts of the lack that shares omit; the last ones count strong signals alone.
constexpr std::array omitted_parts = {0.0F, 0.5F, 0.9F};

using Floats = std::vector<float>;

/// The labels as the units chosen so far leave them, and their multipliers.
struct LabelState {
  Floats value, best;        ///< signal by the rule, and the strongest signal if the rule omits it
  Floats lack;               ///< further signals that reach the label add up to at least this
  Floats last_lack;          ///< a single further signal that reaches the label is at least this
  Floats weight;             ///< of the labels that are neither reached nor out of reach
  Floats multiplier;         ///< y_i
  std::uint32_t number = 0;  ///< of these in the proof
  double reached = 0;        ///< weight
  double within_reach = 0;   ///< weight, with what further units may reach
};

struct Valued {
  std::uint32_t candidate = 0;
  double value = 0;
};

/// sum_i w_i (1 - y_i) + the values c_j of the units to come bound the weight of a subtree.
struct Bound {
  float omitted = 0;
  double fixed = 0;
  std::vector<Valued> order = {};  ///< largest value first
  double total = std::numeric_limits<double>::infinity();
  Floats multiplier = {};
  std::uint32_t number = 0;  ///< of the multipliers in the proof
};

/// The part of the search tree before a node and in the node, if all selections were examined.
struct Progress {
  double begin = 0, size = 1;

  double end() const { return begin + size; }
  /// Child p of n of a node that chooses `free` more units, each child from the candidates after its own:
  /// (1 - p/n)^free of the node lies in it and behind it.
  Progress in_child(std::size_t child, std::size_t children, std::size_t free) const {
    const auto behind = [&](std::size_t p) {
      return std::pow(1 - static_cast<double>(p) / static_cast<double>(children), static_cast<double>(free));
    };
    return {begin + size * (1 - behind(child)), size * (behind(child) - behind(child + 1))};
  }
};

class Search {
 public:
  Search(const CoverageTable& table, const LabelWeights& weights, std::size_t units, double needed,
         EnumerationAim aim, const Effort& left, const RunControl& control)
      : table_(table),
        weights_(weights),
        units_(units),
        needed_(needed),
        aim_(aim),
        left_(left),
        control_(control),
        padded_(table.padded_labels()) {
    // A float's rounding error is below 6e-8 of it, and a lane adds up this many.
    error_ = 1.2e-7 * (static_cast<double>(padded_) / 16 + 8);
    for (std::size_t i = 0; i < table.labels(); ++i) weight_[i] = static_cast<float>(table.label_weight(i));
  }

  std::size_t work() const { return work_; }

  CoverageEnumeration run(std::size_t free) {
    find_strongest(free);
    states_.resize(free + 1);
    LabelState& root = states_.front();
    root.value = root.best = Floats(padded_);
    root.multiplier.assign(padded_, 1.0F);
    log_.add(multipliers(root.multiplier));
    for (std::size_t u = 0; u < table_.installed().size(); ++u) receive(root, table_.installed_signals(u));
    explore(all_numbers(table_.candidates().size()), free, 0);
    result_.is_complete = !is_cut_short_;
    result_.proof = log_.proof(table_.rows());
    return std::move(result_);
  }

 private:
  std::span<const float> multipliers(const Floats& of) const { return std::span(of).first(table_.labels()); }

  void find_strongest(std::size_t free) {
    strongest_.assign(free + 1, Floats(padded_, 0.0F));
    std::vector<float> signals(table_.candidates().size());
    for (std::size_t i = 0; i < table_.labels(); ++i) {
      for (std::uint32_t c = 0; c < signals.size(); ++c) signals[c] = table_.signals(c)[i];
      std::partial_sort(signals.begin(), signals.begin() + static_cast<std::ptrdiff_t>(free), signals.end(),
                        std::greater());
      for (std::size_t k = 1; k <= free; ++k) strongest_[k][i] = strongest_[k - 1][i] + signals[k - 1];
    }
    work_ += table_.cells();
  }

  void receive(LabelState& state, const float* signals) const {
    for (std::size_t i = 0; i < padded_; ++i) {
      const float signal = signals[i];
      state.value[i] += table_.omits_best() ? std::min(state.best[i], signal) : signal;
      state.best[i] = std::max(state.best[i], signal);
    }
  }

  // With unit failure, the strongest of at most K units gives at least a K-th of all their signals, so that
  // these add up to K / (K - 1) of the target.
  void measure(LabelState& state, std::size_t free) const {
    const bool omits = table_.omits_best();
    const float target = table_.target();
    const auto units = static_cast<float>(units_);
    const float together = omits ? target * units / (units - 1) : target;
    state.lack.assign(padded_, 0.0F);
    state.last_lack.assign(padded_, 0.0F);
    state.weight.assign(padded_, 0.0F);
    state.reached = state.within_reach = table_.settled_weight();
    for (std::size_t i = 0; i < table_.labels(); ++i) {
      const float need = target - state.value[i];
      if (need <= 0) {
        state.reached += table_.label_weight(i);
        state.within_reach += table_.label_weight(i);
        continue;
      }
      const float lack = omits ? std::max(need, together - state.value[i] - state.best[i]) : need;
      const bool is_hopeless = strongest_[free][i] < lack;
      state.lack[i] = lack;
      state.last_lack[i] = is_hopeless || (omits && state.best[i] < need) ? out_of_reach : need;
      state.weight[i] = is_hopeless ? 0 : weight_[i];
      if (!is_hopeless) state.within_reach += table_.label_weight(i);
    }
  }

  bool may_suffice(double bound) const { return bound * (1 + error_) >= needed_; }

  bool is_over() {
    // A hopeless search ends early: most of the work is in the first subtrees.
    const auto work = static_cast<double>(work_), max_work = static_cast<double>(left_.steps);
    const bool is_hopeless = work > 0.02 * max_work && work > 4 * max_work * progress_.end();
    is_cut_short_ = is_cut_short_ || is_hopeless || work_ >= left_.steps || left_.is_over(control_);
    return is_cut_short_ || is_done_;
  }

  // Single precision is optimistic, so the exact rule decides.
  void offer(std::optional<std::uint32_t> last) {
    Selection selected(table_.installed().begin(), table_.installed().end());
    for (const std::uint32_t c : chosen_) selected.push_back(table_.candidates()[c]);
    if (last) selected.push_back(table_.candidates()[*last]);
    std::sort(selected.begin(), selected.end());
    constexpr std::size_t entries_per_look = 8;
    work_ += table_.labels() * selected.size() * entries_per_look;
    const double weight = table_.weight(selected);
    if (weight < needed_ || (result_.selected && weight <= result_.weight)) return;
    result_.selected = std::move(selected);
    result_.weight = weight;
    needed_ = weight + weights_.step();
    is_done_ = aim_ == EnumerationAim::first;
  }

  void explore(const std::vector<std::uint32_t>& list, std::size_t free, std::size_t depth) {
    LabelState& state = states_[depth];
    measure(state, free);
    work_ += padded_;
    if (may_suffice(state.reached)) offer({});
    if (free == 0 || list.empty()) return log_.add(CoverageProof::nothing_left);
    if (!may_suffice(state.within_reach)) return log_.add(CoverageProof::out_of_reach);
    if (is_over()) return;
    if (free == 1) return examine_last(list, state);
    const Bound bound = best_bound(list, free, state, depth);
    if (!may_suffice(bound.total)) return log_.add(CoverageProof::bound_fails, bound.omitted, bound.number);
    log_.add(CoverageProof::branch, bound.omitted, bound.number);
    LabelState& next = states_[depth + 1];
    std::size_t children = 0;
    while (children < bound.order.size() && may_suffice(bound.fixed + sum_of_best(bound, children, free)))
      ++children;
    const Progress before = progress_;
    for (std::size_t p = 0; p < children && !is_over(); ++p) {
      if (!may_suffice(bound.fixed + sum_of_best(bound, p, free))) break;  // a better one was found
      if (depth < 2) progress_ = before.in_child(p, children, free);
      const Valued& one = bound.order[p];
      std::vector<std::uint32_t> others;
      const double with_best = bound.fixed + one.value + sum_of_best(bound, p + 1, free - 2);
      for (std::size_t k = p + 1; k < bound.order.size(); ++k) {
        if (!may_suffice(with_best + bound.order[k].value)) break;
        if (!table_.exclude_each_other(one.candidate, bound.order[k].candidate))
          others.push_back(bound.order[k].candidate);
      }
      next.value = state.value;
      next.best = state.best;
      next.multiplier = bound.multiplier;
      next.number = bound.number;
      receive(next, table_.signals(one.candidate));
      work_ += padded_;
      chosen_.push_back(one.candidate);
      log_.add(table_.candidates()[one.candidate]);
      explore(others, free - 1, depth + 1);
      chosen_.pop_back();
    }
    log_.add(CoverageProof::end);
  }

  void examine_last(const std::vector<std::uint32_t>& list, const LabelState& state) {
    log_.add(CoverageProof::single_fails);
    for (const std::uint32_t c : list) {
      const double weight =
          table_.settled_weight() + static_cast<double>(CoverageKernels::reached(
                                        table_.signals(c), state.last_lack.data(), weight_.data(), padded_));
      if (may_suffice(weight)) offer(c);
      if (is_done_) return;
    }
    work_ += padded_ * list.size();
  }

  // The values of `count` candidates of different mounting points, from a place of the order on.
  double sum_of_best(const Bound& bound, std::size_t first, std::size_t count) const {
    double sum = 0;
    for_best(bound, first, count, [&](const Valued& one) { sum += one.value; });
    return sum;
  }

  template <class Visit>
  void for_best(const Bound& bound, std::size_t first, std::size_t count, const Visit& visit) const {
    std::array<std::uint32_t, max_free> points{};
    std::size_t found = 0;
    for (std::size_t p = first; p < bound.order.size() && found < count; ++p) {
      const std::uint32_t point = table_.point(bound.order[p].candidate);
      const auto end = points.begin() + static_cast<std::ptrdiff_t>(found);
      if (std::find(points.begin(), end, point) != end) continue;
      points[found++] = point;
      visit(bound.order[p]);
    }
  }

  CoverageKernels::Shares shares_of(const LabelState& state, float omitted, std::size_t free) {
    const float part = omitted / static_cast<float>(free);
    for (std::size_t i = 0; i < table_.labels(); ++i) {
      const bool counts = state.weight[i] > 0;
      shift_[i] = counts ? part * state.lack[i] : 0;
      scale_[i] = counts ? 1 / ((1 - omitted) * state.lack[i]) : 0;
    }
    return {shift_.data(), scale_.data(), padded_};
  }

  Bound evaluate(const std::vector<std::uint32_t>& list, std::size_t free, const LabelState& state,
                 float omitted, Floats multiplier) {
    Bound bound{.omitted = omitted, .fixed = state.reached, .multiplier = std::move(multiplier)};
    Floats weight(padded_, 0.0F);
    for (std::size_t i = 0; i < table_.labels(); ++i) {
      weight[i] = state.weight[i] * bound.multiplier[i];
      bound.fixed += static_cast<double>(state.weight[i]) * (1 - static_cast<double>(bound.multiplier[i]));
    }
    const CoverageKernels::Shares shares = shares_of(state, omitted, free);
    for (const std::uint32_t c : list)
      bound.order.push_back(
          {c, static_cast<double>(CoverageKernels::value(table_.signals(c), shares, weight.data()))});
    work_ += padded_ * list.size();
    std::ranges::stable_sort(bound.order, std::greater{}, &Valued::value);
    bound.total = bound.fixed + sum_of_best(bound, 0, free);
    return bound;
  }

  Bound best_bound(const std::vector<std::uint32_t>& list, std::size_t free, const LabelState& state,
                   std::size_t depth) {
    Bound best;
    for (const float omitted : omitted_parts)
      for (const bool inherits : {false, true}) {
        if (inherits && depth == 0) continue;
        Bound bound =
            evaluate(list, free, state, omitted, inherits ? state.multiplier : Floats(padded_, 1.0F));
        bound.number = inherits ? state.number : 0;
        if (bound.total < best.total) best = std::move(bound);
        if (!may_suffice(best.total)) return best;
      }
    constexpr std::size_t at_root = 60, below = 10;
    if (depth == 0 || free > 2) {
      const double before = best.total;
      Steps steps{*this, list, free, depth == 0 ? at_root : below, state, best};
      ascend(steps, -before, {});
      if (best.total < before) best.number = log_.add(multipliers(best.multiplier));
    }
    return best;
  }

  // Steps of Polyak's length, towards the weight that is needed, for `ascend`.
  struct Steps {
    Search& search;
    const std::vector<std::uint32_t>& list;
    std::size_t free, max_steps;
    const LabelState& state;
    Bound& best;
    Bound bound = best;  ///< of the present step
    Floats load = Floats(search.padded_);

    bool ends(std::size_t step) {
      return step > max_steps || !search.may_suffice(best.total) || search.is_over();
    }
    bool move(double length) {
      const CoverageKernels::Shares shares = search.shares_of(state, bound.omitted, free);
      std::fill(load.begin(), load.end(), -1.0F);
      search.for_best(bound, 0, free, [&](const Valued& one) {
        CoverageKernels::add(search.table_.signals(one.candidate), shares, load.data());
      });
      double norm = 0;
      for (std::size_t i = 0; i < search.table_.labels(); ++i) {
        const float y = bound.multiplier[i];
        const bool stays = (y >= 1 && load[i] < 0) || (y <= 0 && load[i] > 0);
        if (!stays) norm += static_cast<double>(state.weight[i] * load[i] * load[i]);
      }
      if (norm == 0) return false;
      const double above = std::max(0.0, bound.total - search.needed_ + search.weights_.step());
      const auto by = static_cast<float>(length * above / norm);
      for (std::size_t i = 0; i < search.table_.labels(); ++i)
        bound.multiplier[i] = std::clamp(bound.multiplier[i] - by * load[i], 0.0F, 1.0F);
      return true;
    }
    double evaluate(std::size_t) {
      bound = search.evaluate(list, free, state, bound.omitted, std::move(bound.multiplier));
      if (bound.total < best.total) best = bound;
      return -bound.total;
    }
  };

  const CoverageTable& table_;
  const LabelWeights& weights_;
  std::size_t units_;
  double needed_;
  EnumerationAim aim_;
  Effort left_;
  const RunControl& control_;
  std::size_t padded_;
  double error_ = 0;
  Floats weight_ = Floats(padded_), shift_ = weight_, scale_ = weight_;
  std::vector<Floats> strongest_;      ///< per number of units: the sum of a label's strongest signals
  std::vector<LabelState> states_;     ///< per depth
  std::vector<std::uint32_t> chosen_;  ///< candidates
  std::size_t work_ = 0;
  Progress progress_;
  CoverageLog log_;
  bool is_cut_short_ = false, is_done_ = false;
  CoverageEnumeration result_;
};

// At most one unit. Exact even for tables that are too large for a dense matrix.
CoverageEnumeration examine_few(const CoverageTable& table, std::size_t free, double needed) {
  CoverageEnumeration result{.is_complete = true};
  const auto offer = [&](double weight, std::optional<std::uint32_t> column) {
    if (weight < needed || (result.selected && weight <= result.weight)) return;
    Selection selected(table.installed().begin(), table.installed().end());
    if (column) selected.push_back(*column);
    std::sort(selected.begin(), selected.end());
    result.selected = std::move(selected);
    result.weight = weight;
  };
  offer(table.settled_weight(), {});
  const std::vector<double> weights = free > 0 ? table.weights_with_one() : std::vector<double>();
  for (std::size_t c = 0; c < weights.size(); ++c) offer(weights[c], table.candidates()[c]);
  result.proof.rows.assign(table.rows().begin(), table.rows().end());
  result.proof.steps = {free > 0 ? CoverageProof::single_fails : CoverageProof::nothing_left};
  return result;
}

}  // namespace

CoverageEnumeration enumerate_coverage(CoverageTable& table, const LabelWeights& weights, std::size_t units,
                                       double needed, EnumerationAim aim, Effort& left,
                                       const RunControl& control) {
  const std::size_t installed = table.installed().size();
  const std::size_t free = std::min(units - std::min(units, installed), table.candidates().size());
  if (free <= 1) return examine_few(table, free, needed);
  if (free > max_free || table.cells() > max_cells) return {};
  table.fill();
  Search search(table, weights, installed + free, needed, aim, left, control);
  CoverageEnumeration result = search.run(free);
  left.steps -= std::min<std::uint64_t>(left.steps, search.work());
  return result;
}

}  // namespace shelfbeam::detail
