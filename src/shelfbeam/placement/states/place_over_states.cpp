#include "shelfbeam/placement/states/place_over_states.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/placement/problem/mounts.hpp"
#include "shelfbeam/placement/states/state_cuts.hpp"

namespace shelfbeam {

namespace {

class Search {
 public:
  Search(const StateTable& states, const PlacementProblem& problem, std::span<const std::uint32_t> allowed,
         const PlaceOptions& options, const RunControl& control)
      : states_(states),
        problem_(problem),
        allowed_(allowed),
        options_(options),
        control_(control),
        mounts_(states.table),
        cuts_(states, problem, allowed),
        end_(std::chrono::steady_clock::now() +
             std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                 std::chrono::duration<double>(options.time_limit_s))) {}

  StatePlacement run() {
    find_unreachable();
    if (!best_.unreachable.empty()) {
      best_.lower_bound = std::numeric_limits<double>::infinity();
      return best_;
    }
    while (!is_over()) {
      PlaceOptions own = options_;
      own.time_limit_s = std::max(1.0, seconds_left());
      own.settles_ties = false;
      const Placement master = place(cuts_.table(), master_problem(), own, control_);
      ++best_.calls;
      if (master.status == Status::infeasible) {
        best_.lower_bound = std::numeric_limits<double>::infinity();
        return best_;
      }
      raise(master);
      if (!master.has_selection()) break;
      const std::vector<std::uint32_t> misses = misses_of(states_, problem_, master.selected);
      const std::size_t added = cuts_.add(master.selected, misses);
      if (const auto repaired = repair(master.selected)) take(*repaired);
      control_.report("placing over states", -1);
      if (best_.is_proven() || added == 0) break;
    }
    best_.cuts = cuts_.size();
    if (best_.has_selection()) spread_misses();
    return best_;
  }

 private:
  using Selection = std::vector<std::uint32_t>;

  double seconds_left() const {
    return std::chrono::duration<double>(end_ - std::chrono::steady_clock::now()).count();
  }
  bool is_over() const { return control_.cancelled() || seconds_left() <= 0; }

  // Shares add up in both models; in the non-cooperative one they are 0 or 1.
  PlacementProblem master_problem() const {
    PlacementProblem master = problem_;
    master.model = CommunicationModel::cooperative;
    return master;
  }

  double value_of(const Selection& selected) const {
    if (problem_.combination != Combination::spend) return static_cast<double>(selected.size());
    double spend = 0;
    for (const std::uint32_t j : selected) spend += price_to_spend(states_.table.transceivers[j]);
    return spend;
  }

  void raise(const Placement& master) {
    const double bound = problem_.combination == Combination::spend
                             ? master.lower_bound
                             : std::ceil(master.count_lower_bound - 1e-6);
    best_.lower_bound = std::max(best_.lower_bound, bound);
  }

  void find_unreachable() {
    // Options of a mounting point exclude one another, but all of them give at least as much as any one.
    Selection all(states_.table.columns());
    std::iota(all.begin(), all.end(), 0U);
    std::erase_if(all, [&](std::uint32_t j) { return !mounts_.available(j); });
    const std::vector<std::uint32_t> misses = misses_of(states_, problem_, all);
    for (std::uint32_t i = 0; i < misses.size(); ++i)
      if (misses[i] > allowed_[i]) best_.unreachable.push_back(i);
  }

  bool is_feasible(const std::vector<std::uint32_t>& misses) const {
    for (std::size_t i = 0; i < misses.size(); ++i)
      if (misses[i] > allowed_[i]) return false;
    return true;
  }

  static std::uint64_t sum(const std::vector<std::uint32_t>& misses) {
    return std::accumulate(misses.begin(), misses.end(), std::uint64_t{0});
  }

  std::uint64_t excess(const std::vector<std::uint32_t>& misses) const {
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < misses.size(); ++i)
      total += misses[i] > allowed_[i] ? misses[i] - allowed_[i] : 0;
    return total;
  }

  bool fits(std::uint32_t j, const Selection& selected) const {
    if (!mounts_.available(j) || std::binary_search(selected.begin(), selected.end(), j)) return false;
    bool fits = true;
    mounts_.for_each_conflict(j, [&](std::uint32_t other) {
      if (std::binary_search(selected.begin(), selected.end(), other)) fits = false;
    });
    return fits;
  }

  static Selection with(Selection selected, std::uint32_t j) {
    selected.insert(std::lower_bound(selected.begin(), selected.end(), j), j);
    return selected;
  }
  static Selection without(Selection selected, std::uint32_t j) {
    selected.erase(std::lower_bound(selected.begin(), selected.end(), j));
    return selected;
  }

  // Adds the units that remove most misses until every label keeps to its allowance, then drops units that
  // are not required.
  std::optional<Selection> repair(Selection selected) const {
    std::vector<std::uint32_t> misses = misses_of(states_, problem_, selected);
    while (!is_feasible(misses)) {
      if (is_over() || value_of(selected) >= best_.value) return {};
      std::optional<std::uint32_t> best_unit;
      std::pair<double, std::uint64_t> best{};
      std::vector<std::uint32_t> best_misses;
      const auto now = static_cast<double>(excess(misses));
      for (std::uint32_t j = 0; j < states_.table.columns(); ++j) {
        if (!fits(j, selected)) continue;
        std::vector<std::uint32_t> then = misses_of(states_, problem_, with(selected, j));
        const double price = problem_.combination == Combination::spend
                                 ? std::max(1e-9, price_to_spend(states_.table.transceivers[j]))
                                 : 1;
        const std::pair<double, std::uint64_t> rank{(static_cast<double>(excess(then)) - now) / price,
                                                    sum(then)};
        if (best_unit && rank >= best) continue;
        best_unit = j;
        best = rank;
        best_misses = std::move(then);
      }
      if (!best_unit) return {};
      selected = with(std::move(selected), *best_unit);
      misses = std::move(best_misses);
    }
    for (std::size_t k = selected.size(); k-- > 0;) {
      if (states_.table.transceivers[selected[k]].installed) continue;
      Selection fewer = without(selected, selected[k]);
      if (is_feasible(misses_of(states_, problem_, fewer))) selected = std::move(fewer);
    }
    return selected;
  }

  void take(const Selection& selected) {
    const double value = value_of(selected);
    if (value >= best_.value) return;
    best_.selected = selected;
    best_.value = value;
    best_.misses = misses_of(states_, problem_, selected);
  }

  // Exchanges units as long as the labels are missed less often at the same value: stopping at the first
  // selection that fits the sample would fit its accidents.
  void spread_misses() {
    for (bool improves = true; improves && !is_over();) {
      improves = false;
      const Selection from = best_.selected;
      for (const std::uint32_t out : from) {
        if (states_.table.transceivers[out].installed) continue;
        const Selection rest = without(best_.selected, out);
        for (std::uint32_t in = 0; in < states_.table.columns() && !is_over(); ++in) {
          if (in == out || !fits(in, rest)) continue;
          Selection changed = with(rest, in);
          if (value_of(changed) > best_.value) continue;
          std::vector<std::uint32_t> misses = misses_of(states_, problem_, changed);
          if (!is_feasible(misses) || sum(misses) >= sum(best_.misses)) continue;
          best_.value = value_of(changed);
          best_.selected = std::move(changed);
          best_.misses = std::move(misses);
          improves = true;
          break;
        }
        if (improves) break;
      }
    }
  }

  const StateTable& states_;
  const PlacementProblem& problem_;
  std::span<const std::uint32_t> allowed_;
  const PlaceOptions& options_;
  const RunControl& control_;
  Mounts mounts_;
  StateCuts cuts_;
  std::chrono::steady_clock::time_point end_;
  StatePlacement best_;
};

}  // namespace

StatePlacement place_over_states(const StateTable& states, const PlacementProblem& problem,
                                 std::span<const std::uint32_t> allowed, const PlaceOptions& options,
                                 const RunControl& control) {
  if (problem.objective != Objective::count || problem.combination == Combination::weighted)
    throw InputError("objective", "is not the number or the price of units",
                     "placements over states minimise these");
  check_problem(states.table, problem);
  return Search(states, problem, allowed, options, control).run();
}

}  // namespace shelfbeam
