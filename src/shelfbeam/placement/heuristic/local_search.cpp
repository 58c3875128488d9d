#include <algorithm>
#include <limits>
#include <random>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/math/order.hpp"
#include "shelfbeam/placement/heuristic/searches.hpp"
#include "shelfbeam/placement/kernels/active_rows.hpp"

namespace shelfbeam::detail {

namespace {

// More candidates per row would make results worse, not only slower: the same few would win too often.
constexpr std::size_t max_supporters = 24;

class Walk {
 public:
  Walk(const Instance& instance, const SearchMatrix& all, const Selection& start, std::uint32_t seed)
      : instance_(instance),
        all_(all),
        rule_(receiving(instance.problem)),
        rows_(all, rule_),
        demand_(rule_ == Receiving::second_best ? 2.0F : 1.0F),
        price_(all.columns(), 1.0),
        is_free_(instance.available),
        in_(marked(all.columns(), start)),
        touched_(all.columns(), 0),
        random_(seed) {
    if (instance.is_weighted())
      for (std::size_t j = 0; j < price_.size(); ++j) price_[j] = static_cast<double>(instance.cost[j]);
    if (margin_of(instance, all, start, memory_).is_met) best_cost_ = cost();
    rows_.add_hardest(start, ActiveRows::at_first);
    follow_rows();
  }

  void run(const Effort& effort, const RunControl& control) {
    constexpr std::uint64_t between_looks = 64;
    for (std::uint64_t move = 1; move <= effort.steps; ++move) {
      if (move % between_looks == 0) {
        if (effort.is_over(control)) return;
        control.report(Task::local_search, -1, fmt::format("{} moves", move));
        recount();  // sums updated by differences drift
      }
      now_ = move;
      while (meets_rows()) {
        if (effort.is_over(control)) return;
        if (!try_on_all()) continue;  // rows were added
        if (!remove_cheapest()) return;
      }
      if (!exchange()) return;
    }
  }

  Found best() const { return {best_, best_cost_}; }

 private:
  // Value per price; a unit of price zero comes first, regardless of its contribution.
  static double ratio(double value, double price) { return price > 0 ? value / price : value * 1e30; }

  double cost() const {
    double sum = 0;
    for (std::size_t j = 0; j < in_.size(); ++j)
      if (in_[j]) sum += price_[j];
    return sum;
  }

  // Sets weights and supporters of new rows.
  void follow_rows() {
    weight_.resize(rows_.padded(), 0.0F);
    for (std::size_t r = supporters_.size(); r < rows_.rows(); ++r) {
      const LabelId row = rows_.row(r);
      std::vector<ColumnId> columns = numbers_where<ColumnId>(
          in_.size(), [&](ColumnId j) { return is_free_[j] && rows_.used_of(row, j) > 0; });
      const std::size_t count = std::min(max_supporters, columns.size());
      std::ranges::partial_sort(columns, columns.begin() + static_cast<std::ptrdiff_t>(count), {},
                                [&](ColumnId j) { return std::pair(-all_.column(j)[row], j); });
      columns.resize(count);
      supporters_.push_back(std::move(columns));
      weight_[r] = 1;
    }
    recount();
  }

  void receive(std::uint32_t j) {
    const Receiving rule = rule_ == Receiving::sum_without_best ? rule_ : Receiving::sum;
    SearchKernels::receive(rule, rows_.column(j), rows_.padded(), held_.data(), largest_.data());
  }

  void recount() {
    held_.assign(rows_.padded(), 0.0F);
    largest_.assign(rows_.padded(), 0.0F);
    for (std::uint32_t j = 0; j < in_.size(); ++j)
      if (in_[j]) receive(j);
  }

  bool meets_rows() {
    unmet_.clear();
    const float enough = demand_ * (1 - static_cast<float>(search_tolerance));
    for (std::uint32_t r = 0; r < rows_.rows(); ++r)
      if (held_[r] < enough) unmet_.push_back(r);
    return unmet_.empty();
  }

  // Keeps the selection if it reaches all labels; otherwise adds rows that it misses.
  bool try_on_all() {
    const Selection selected = numbers_where<ColumnId>(in_);
    const Margin margin = margin_of(instance_, all_, selected, memory_);
    if (margin.is_met) {
      if (const double price = cost(); price < best_cost_) {
        best_ = selected;
        best_cost_ = price;
      }
      return true;
    }
    if (!rows_.add_missed(std::span(memory_).first(all_.rows()), margin.label)) rows_.tighten(margin.label);
    follow_rows();
    return false;
  }

  double lost_with(std::uint32_t j) const {
    return static_cast<double>(
        SearchKernels::loss(rows_.column(j), weight_.data(), held_.data(), demand_, rows_.padded()));
  }

  bool remove_cheapest() {
    std::uint32_t out = none;
    double min_loss = std::numeric_limits<double>::infinity();
    for (std::uint32_t j = 0; j < in_.size(); ++j) {
      if (!in_[j] || !is_free_[j] || touched_[j] == now_) continue;
      const double loss = ratio(lost_with(j), price_[j]);
      if (out == none || loss < min_loss || (loss == min_loss && touched_[j] < touched_[out])) {
        out = j;
        min_loss = loss;
      }
    }
    if (out == none) return false;
    in_[out] = false;
    touched_[out] = now_;
    if (rule_ == Receiving::sum_without_best) {
      recount();
    } else {
      const float* const lost = rows_.column(out);
      for (std::size_t r = 0; r < rows_.padded(); ++r) held_[r] -= lost[r];
    }
    return true;
  }

  // For a random missed row, adds the supporter j with the largest worth per price,
  //
  //   worth_j = sum_i w_i min(a_ij, max(0, demand - held_i)),
  //
  // less the losses of chosen units in conflict with j. Then removes the units with the least loss per price,
  //
  //   loss_j = sum_i w_i max(0, a_ij - max(0, held_i - demand)),
  //
  // until the selection costs less than the incumbent. Rows missed afterwards gain weight 1.
  bool exchange() {
    const std::uint32_t row = unmet_[random_() % unmet_.size()];
    std::uint32_t in = none;
    double max_worth = 0;
    for (const ColumnId j : supporters_[row]) {
      if (in_[j] || (touched_[j] > 0 && touched_[j] + 1 >= now_) || price_[j] >= best_cost_) continue;
      double gained = static_cast<double>(
          SearchKernels::worth(rows_.column(j), weight_.data(), held_.data(), demand_, rows_.padded()));
      for (const ColumnId other : instance_.excludes[j])
        if (in_[other]) gained -= lost_with(other);
      const double worth = ratio(gained, price_[j]);
      if (in == none || worth > max_worth || (worth == max_worth && touched_[j] < touched_[in])) {
        in = j;
        max_worth = worth;
      }
    }
    if (in != none) {
      in_[in] = true;
      touched_[in] = now_;
      bool replaces = false;
      for (const ColumnId other : instance_.excludes[in]) {
        if (!in_[other]) continue;
        replaces = true;
        in_[other] = false;
        touched_[other] = now_;
      }
      if (replaces)
        recount();
      else
        receive(in);
    }
    constexpr double rounding = 1e-12;
    while (cost() >= best_cost_ * (1 - rounding))
      if (!remove_cheapest()) return false;
    meets_rows();
    for (const std::uint32_t r : unmet_) weight_[r] += 1;
    return true;
  }

  static constexpr std::uint32_t none = ~std::uint32_t{0};

  const Instance& instance_;
  const SearchMatrix& all_;
  Receiving rule_;
  ActiveRows rows_;
  float demand_;
  std::vector<double> price_;
  std::vector<bool> is_free_, in_;
  std::vector<std::uint64_t> touched_;  ///< last move that added or removed the column
  std::mt19937 random_;
  std::uint64_t now_ = 0;
  std::vector<std::vector<ColumnId>> supporters_;  ///< by row: the free columns with the largest signals
  std::vector<float> weight_, held_, largest_, memory_;
  std::vector<std::uint32_t> unmet_;
  std::optional<Selection> best_;
  double best_cost_ = std::numeric_limits<double>::infinity();
};

}  // namespace

std::optional<Selection> local_search(const Instance& instance, const SearchMatrix& all,
                                      const Selection& start, const Effort& effort, std::uint32_t seed,
                                      const RunControl& control) {
  return best_of_walks(seed, effort, control,
                       [&](std::uint32_t own_seed) { return Walk(instance, all, start, own_seed); });
}

}  // namespace shelfbeam::detail
