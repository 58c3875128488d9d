#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/math/order.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/placement/kernels/search_matrix.hpp"
#include "shelfbeam/placement/kernels/similar_columns.hpp"
#include "shelfbeam/placement/kernels/walks.hpp"
#include "shelfbeam/placement/problem/effort.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam::detail {

/// The lack L(T) = sum_i max(0, demand - S_i) of rows that all have to be met, S_i = sum_j a_ij T_j, less the
/// largest of these if a unit may fail. Entries are clipped at 1, or 0 and 1 (non-cooperative). About 6 % of
/// the moves are accepted at the hot end, 3 % at the cold end.
template <class Rows>
struct TotalLack {
  static double hot() { return 0.03; }  ///< in requirements
  static double cold() { return 0.015; }
  float lack_after(const SearchKernels::Held& held, const float* out, const float* in, float demand) const {
    return SearchKernels::lack_after(held, out, in, demand,
                                     static_cast<const Rows&>(*this).matrix().padded());
  }
};

/// Simulated annealing of the total lack L(T) at a fixed count (searches.hpp), on rows that grow. Rows has
///
///   matrix()                        has rows(), padded() and column(j) as ActiveRows
///   max_moves                       between two counts of the signals
///   excuse(held, best)              optional: raises the sums of rows that need not be met now; `best`:
///                                   their largest signals, which then do not count, or empty
///   lack_after(held, out, in, demand)  L after an exchange; 0 or less if all rows seem to be met
///   hot(), cold()                   temperatures
///   reaches_all(selected)           tests a selection by the whole problem, in double precision
///   add_missed()                    adds rows that the selection last tested misses; false if none is new
///   best()                          optional: what counts as found if no selection passed the test
template <class Rows>
class AnnealingWalk {
 public:
  /// `all`: signals that show which columns are similar.
  AnnealingWalk(const Instance& instance, const SearchMatrix& all, Rows rows, const Selection& start,
                std::uint32_t seed)
      : instance_(instance),
        rows_(std::move(rows)),
        in_(marked(all.columns(), start)),
        candidates_(numbers_where<ColumnId>(instance.available)),
        similar_(all, candidates_),
        random_(seed) {
    for (const ColumnId j : start) (instance.available[j] ? free_ : fixed_).push_back(j);
    if (rows_.reaches_all(start)) fewest_ = start.size();
    recount();
  }

  void run(const Effort& effort, const RunControl& control) {
    // About a millisecond.
    const std::uint64_t between_looks =
        std::clamp<std::uint64_t>(4'000'000 / (rows_.matrix().padded() + 1), 16, 4096);
    const std::uint64_t cooling = std::clamp(effort.steps / coolings, shortest_cooling, longest_cooling);
    for (std::uint64_t move = 0; move < effort.steps; ++move) {
      if (move % between_looks == 0) {
        if (effort.is_over(control)) return;
        control.report(Task::annealing, -1, fmt::format("{} moves", move));
      }
      if (move % Rows::max_moves == 0) recount();  // sums updated by differences drift
      while (lack_ <= 0 && !has_failed_ && meets_all()) {
        if (free_.empty() || effort.is_over(control)) return;
        drop_weakest();
      }
      if (free_.empty() || free_.size() == candidates_.size()) return;
      const double part = static_cast<double>(move % cooling) / static_cast<double>(cooling);
      exchange(rows_.hot() * std::pow(rows_.cold() / rows_.hot(), part));
    }
  }

  Found best() const {
    if constexpr (requires { rows_.best(); })
      if (!best_) return rows_.best();
    return {best_, static_cast<double>(fewest_)};
  }

 private:
  const float* column(ColumnId j) const { return rows_.matrix().column(j); }

  Selection selection() const { return numbers_where<ColumnId>(in_); }

  // Within a cooling of the given number of moves, u rises from 0 to 1 and
  //
  //   temperature = hot (cold / hot)^u.
  static constexpr std::uint64_t longest_cooling = 2'000'000, shortest_cooling = 2'500, coolings = 4;
  static constexpr float demand = 1 - static_cast<float>(search_tolerance);

  void recount() {
    held_.assign(rows_.matrix().padded(), 0.0F);
    // Padding lacks nothing.
    std::fill(held_.begin() + static_cast<std::ptrdiff_t>(rows_.matrix().rows()), held_.end(), 1.0F);
    for (const ColumnId j : selection())
      SearchKernels::receive(Receiving::sum, column(j), held_.size(), held_.data(), nullptr);
    rank();
    if constexpr (requires { rows_.excuse(held_, best_signal_); }) rows_.excuse(held_, best_signal_);
    zeros_.assign(held_.size(), 0.0F);
    lack_ = lack_after(zeros_.data(), zeros_.data());
  }

  float lack_after(const float* out, const float* in) const {
    const bool fails = instance_.problem.redundant;
    return rows_.lack_after({held_.data(), fails ? best_signal_.data() : nullptr, second_signal_.data()}, out,
                            in, demand);
  }

  // The two largest signals of every row, if a unit may fail.
  void rank() {
    if (!instance_.problem.redundant) return;
    best_signal_.assign(held_.size(), 0.0F);
    second_signal_.assign(held_.size(), 0.0F);
    for (const auto* const part : {&fixed_, &free_})
      for (const ColumnId j : *part)
        SearchKernels::receive(Receiving::second_best, column(j), held_.size(), second_signal_.data(),
                               best_signal_.data());
  }

  void drop_weakest() {
    std::size_t weakest = 0;
    float min_lack = std::numeric_limits<float>::infinity();
    for (std::size_t k = 0; k < free_.size(); ++k) {
      const float lack = lack_after(column(free_[k]), zeros_.data());
      if (lack >= min_lack) continue;
      min_lack = lack;
      weakest = k;
    }
    in_[free_[weakest]] = false;
    free_[weakest] = free_.back();
    free_.pop_back();
    recount();
  }

  // Keeps the selection if it reaches all labels; otherwise adds rows that it misses. If no row is new, only
  // single precision accepts the selection: it has failed until an exchange changes it.
  bool meets_all() {
    const Selection selected = selection();
    while (!rows_.reaches_all(selected)) {
      if (!rows_.add_missed()) {
        has_failed_ = true;
        return false;
      }
      recount();
      if (lack_ > 0) return false;
    }
    if (selected.size() < fewest_) {
      best_ = selected;
      fewest_ = selected.size();
    }
    return true;
  }

  std::uint32_t bits() { return static_cast<std::uint32_t>(random_()); }
  std::size_t index(std::size_t n) { return to_index(bits(), static_cast<std::uint32_t>(n)); }
  double unit() { return to_uniform(bits()); }

  // The candidate to exchange for `out`: mostly a similar one, which leaves the rest in place, sometimes any.
  ColumnId another_for(ColumnId out) {
    constexpr double any = 0.1, nearest = 0.4;
    constexpr std::size_t nearest_count = 8;
    const double kind = unit();
    if (kind < any) return candidates_[index(candidates_.size())];
    const std::span<const ColumnId> near = similar_.to(out);
    return near[index(kind < any + nearest ? std::min(nearest_count, near.size()) : near.size())];
  }

  // A walk that minimises a spend raises no price.
  bool is_excluded(ColumnId in, ColumnId out) const {
    if (instance_.problem.combination == Combination::spend &&
        instance_.table.transceivers[in].cost > instance_.table.transceivers[out].cost)
      return true;
    return std::ranges::any_of(instance_.excludes[in],
                               [&](std::uint32_t other) { return other != out && in_[other]; });
  }

  // A random exchange, accepted with probability min(1, exp((L(before) - L(after)) / temperature)).
  void exchange(double temperature) {
    ColumnId& place = free_[index(free_.size())];
    const ColumnId out = place, in = another_for(out);
    if (in_[in] || is_excluded(in, out)) return;
    const float lack = lack_after(column(out), column(in));
    if (lack > lack_ && unit() >= std::exp(static_cast<double>(lack_ - lack) / temperature)) return;
    in_[out] = false;
    in_[in] = true;
    place = in;
    has_failed_ = false;
    SearchKernels::exchange(column(out), column(in), held_.size(), held_.data());
    lack_ = lack;
    if (lack_ <= 0)
      recount();
    else
      rank();
  }

  const Instance& instance_;
  Rows rows_;
  std::vector<bool> in_;
  std::vector<ColumnId> fixed_, free_, candidates_;
  SimilarColumns similar_;
  std::vector<float> held_, zeros_, best_signal_, second_signal_;
  float lack_ = 0;           ///< L(T)
  bool has_failed_ = false;  ///< misses a label on all rows, although none of them is new
  std::size_t fewest_ = std::numeric_limits<std::size_t>::max();
  std::optional<Selection> best_;
  std::mt19937 random_;
};

}  // namespace shelfbeam::detail
