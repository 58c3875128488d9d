#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/math/order.hpp"
#include "shelfbeam/placement/bound/count_bound.hpp"
#include "shelfbeam/placement/problem/cover_rows.hpp"

namespace shelfbeam::detail {

namespace {

// A label and the columns that contribute at least the share t to it.
struct Split {
  BoundRow row;
  std::vector<ColumnId> strong;
};

class Cases {
 public:
  Cases(const Instance& instance, const milp::Backend& backend, const SelectionSet& selections,
        const Effort& effort, const RunControl& control)
      : instance_(instance),
        backend_(backend),
        selections_(selections),
        enough_(static_cast<double>(selections.max_count) + 1e-6),
        effort_(effort),
        control_(control),
        cover_(instance, selections.max_count),
        ones_(instance.columns(), 1.0) {}

  // True if no selection without the columns `without` remains; `open` is the LP bound of these selections.
  bool close(const LpBound& open, const std::vector<ColumnId>& without) {
    if (open.dual.bound >= enough_) return true;
    if (open.x.empty()) return false;
    const std::optional<Split> split = best_split(open);
    if (!split) return false;
    std::vector<BoundRow> with_strong = rows_of(open);
    with_strong.push_back(split->row);
    if (!close_case(open, std::move(with_strong), without)) return false;
    std::vector<ColumnId> without_strong = without;
    without_strong.insert(without_strong.end(), split->strong.begin(), split->strong.end());
    return is_empty(open, without_strong) || close_case(open, rows_of(open), without_strong);
  }

 private:
  static constexpr int max_cases = 64;
  static constexpr double deepest = 5;  // levels

  // True if some label cannot be reached without these columns.
  bool is_empty(const LpBound& open, const std::vector<ColumnId>& without) const {
    constexpr double rounding = 1e-9;
    const std::vector<bool> is_out = marked(instance_.columns(), without);
    return std::any_of(open.labels.begin(), open.labels.end(), [&](LabelId label) {
      double outside = 0;
      cover_.for_entries(label, [&](std::uint32_t j, double a) { outside += is_out[j] ? 0 : a; });
      return outside * (1 + rounding) < cover_.bound(label);
    });
  }

  bool close_case(const LpBound& open, std::vector<BoundRow> rows, const std::vector<ColumnId>& without) {
    if (effort_.is_over(control_) || ++cases_ > max_cases) return false;
    control_.report(Task::bound, -1, fmt::format("at most {} units, case {}", selections_.max_count, cases_));
    SelectionSet selections = selections_;
    selections.without = without;
    const LpBound bound = lp_bound(
        instance_, ones_, backend_,
        {.effort = effort_, .enough = enough_, .selections = std::move(selections), .rows = std::move(rows)},
        {control_.threads, control_.cancel});
    if (bound.dual.bound >= enough_) return true;
    // Gives up if more than `deepest` further levels would be required at this pace.
    const double gained = bound.dual.bound - open.dual.bound, lacking = enough_ - bound.dual.bound;
    return bound.complete && lacking <= deepest * gained && close(bound, without);
  }

  // The label with the largest multipliers for which some t satisfies 0.5 <= sum_{j: a_ij >= t} x_j <= 0.8.
  std::optional<Split> best_split(const LpBound& open) const {
    std::vector<double> weight(instance_.rows(), 0.0);
    for (std::size_t k = 0; k < open.rows.size(); ++k) weight[open.rows[k].label] += open.y[k];
    std::optional<Split> best;
    double max_weight = 0;
    for (std::uint32_t label = 0; label < instance_.rows(); ++label) {
      if (weight[label] <= max_weight) continue;
      std::optional<Split> split = halved(label, open.x);
      if (!split) continue;
      max_weight = weight[label];
      best = std::move(split);
    }
    return best;
  }

  std::optional<Split> halved(LabelId label, const std::vector<double>& x) const {
    constexpr double min_part = 0.5, max_part = 0.8;
    struct Term {
      double a = 0;
      std::uint32_t column = 0;
    };
    std::vector<Term> terms;
    cover_.for_entries(label, [&](std::uint32_t j, double a) { terms.push_back({a, j}); });
    std::ranges::sort(terms, {}, [](const Term& term) { return std::pair(-term.a, term.column); });
    double sum = 0;
    std::size_t count = 0;
    while (count < terms.size() && sum < min_part) {
      const double a = terms[count].a;
      while (count < terms.size() && terms[count].a == a) sum += x[terms[count++].column];
    }
    if (!(sum >= min_part && sum <= max_part)) return std::nullopt;
    Split split;
    split.row.label = label;
    split.row.strongest = terms[count - 1].a;
    for (std::size_t k = 0; k < count; ++k) split.strong.push_back(terms[k].column);
    return split;
  }

  const Instance& instance_;
  const milp::Backend& backend_;
  const SelectionSet& selections_;
  double enough_;
  Effort effort_;
  const RunControl& control_;
  CoverRows cover_;
  std::vector<double> ones_;
  int cases_ = 0;
};

}  // namespace

bool prove_count_exceeds(const Instance& instance, const milp::Backend& backend,
                         const SelectionSet& selections, const LpBound& open, const Effort& effort,
                         const RunControl& control) {
  constexpr double max_lacking = 0.5;
  if (open.dual.bound < static_cast<double>(selections.max_count) - max_lacking) return false;
  return Cases(instance, backend, selections, effort, control).close(open, selections.without);
}

}  // namespace shelfbeam::detail
