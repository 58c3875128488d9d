#include "shelfbeam/placement/states/place_over_states.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/base/error.hpp"
#include "shelfbeam/placement/problem/mounts.hpp"
#include "shelfbeam/placement/states/margin_search.hpp"
#include "shelfbeam/placement/states/state_cuts.hpp"
#include "shelfbeam/placement/states/state_search.hpp"

namespace shelfbeam {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
// Parts of the time that is left.
constexpr double share_of_master = 0.3;  ///< one placement on cuts
constexpr double share_of_margin = 0.1;  ///< one placement with margins
constexpr int max_margin_searches = 5;

class Solver {
 public:
  Solver(const StateTable& states, const PlacementProblem& problem, const MissAllowance& allowance,
         const PlaceOptions& options, std::optional<double> enough, const RunControl& control)
      : states_(states),
        problem_(problem),
        allowance_(allowance),
        options_(options),
        enough_(enough),
        control_(control),
        deadline_(options.time_limit_s),
        cuts_(states, problem, allowance),
        search_(states, problem, allowance, [this] { return is_over(); }) {}

  StatePlacement run() {
    if (is_possible()) {
      if (!enough_) start();
      while (!is_over() && raise()) {
      }
    } else {
      best_.lower_bound = infinite;
    }
    best_.cuts = cuts_.size();
    if (best_.has_selection()) take(search_.spread(best_.selected));
    return std::move(best_);
  }

 private:
  bool is_over() const { return control_.cancelled() || deadline_.has_passed(); }

  void start() {
    if (!options_.start.empty())
      if (const auto repaired = search_.repaired(options_.start, infinite)) take(*repaired);
    MarginSearch margins(states_, problem_, allowance_);
    for (int k = 0; k < max_margin_searches && !is_over(); ++k) {
      control_.report("placing over states", -1, "with margins");
      const auto selected = margins.next(share_of_margin * deadline_.seconds_left(), options_, control_);
      if (selected.empty()) return;
      if (const auto repaired = search_.repaired(selected, best_.value)) take(*repaired);
    }
  }

  // Solves the cuts. Returns whether new ones may raise the bound.
  bool raise() {
    PlaceOptions own = options_;
    own.time_limit_s = std::max(1.0, share_of_master * deadline_.seconds_left());
    own.settles_ties = false;
    own.start.clear();
    PlacementProblem master = problem_;
    // Shares add up in both models; in the non-cooperative one they are 0 or 1.
    master.model = CommunicationModel::cooperative;
    const Placement placement = place(cuts_.table(), master, own, control_);
    ++best_.calls;
    if (placement.status == Status::infeasible) {
      best_.lower_bound = infinite;
      return false;
    }
    best_.lower_bound = std::max(best_.lower_bound, problem_.combination == Combination::spend
                                                        ? placement.lower_bound
                                                        : std::ceil(placement.count_lower_bound - 1e-6));
    if (!placement.has_selection()) return false;
    const std::size_t added = cuts_.add(placement.selected, misses_of(states_, problem_, placement.selected));
    if (!enough_) improve(placement.selected);
    control_.report("placing over states", -1,
                    best_.has_selection() ? fmt::format("{:g}, at least {:g}", best_.value, best_.lower_bound)
                                          : fmt::format("at least {:g}", best_.lower_bound));
    return added > 0 && !best_.is_proven() && !(enough_ && best_.lower_bound >= *enough_);
  }

  void improve(const std::vector<std::uint32_t>& selected) {
    if (const auto repaired = search_.repaired(selected, best_.value)) take(*repaired);
    if (problem_.combination == Combination::spend || !best_.has_selection() || has_tried_fewer_) return;
    while (!best_.is_proven() && !is_over()) {
      const auto fewer = search_.with_fewer(best_.selected);
      has_tried_fewer_ = !fewer;
      if (!fewer) break;
      take(*fewer);
    }
  }

  void take(const std::vector<std::uint32_t>& selected) {
    StateMisses misses = misses_of(states_, problem_, selected);
    const double value = state_value(states_, problem_, selected);
    if (!search_.fits(misses) || value > best_.value) return;
    if (value < best_.value) has_tried_fewer_ = false;
    best_.selected = selected;
    best_.value = value;
    best_.misses = std::move(misses);
  }

  // Names the labels that are missed too often by all units together; if no label alone is, all that are
  // missed.
  bool is_possible() {
    // Options of a mounting point exclude one another, but all of them give at least as much as any one.
    const Mounts mounts(states_.table);
    std::vector<std::uint32_t> all(states_.table.columns());
    std::iota(all.begin(), all.end(), 0U);
    std::erase_if(all, [&](std::uint32_t j) { return !mounts.available(j); });
    const StateMisses misses = misses_of(states_, problem_, all);
    for (std::uint32_t i = 0; i < misses.of_label.size(); ++i)
      if (misses.of_label[i] > allowance_.limit(i)) best_.unreachable.push_back(i);
    const bool fits = search_.fits(misses);
    if (!fits && best_.unreachable.empty())
      for (std::uint32_t i = 0; i < misses.of_label.size(); ++i)
        if (misses.of_label[i] > 0) best_.unreachable.push_back(i);
    return fits;
  }

  const StateTable& states_;
  const PlacementProblem& problem_;
  const MissAllowance& allowance_;
  const PlaceOptions& options_;
  std::optional<double> enough_;  ///< for a bound alone
  const RunControl& control_;
  Deadline deadline_;
  StateCuts cuts_;
  StateSearch search_;
  StatePlacement best_;
  bool has_tried_fewer_ = false;
};

void check(const StateTable& states, const PlacementProblem& problem) {
  if (problem.objective != Objective::count || problem.combination == Combination::weighted)
    throw InputError("objective", "is not the number or the price of units",
                     "placements over states minimise these");
  check_problem(states.table, problem);
}

}  // namespace

StatePlacement place_over_states(const StateTable& states, const PlacementProblem& problem,
                                 const MissAllowance& allowance, const PlaceOptions& options,
                                 const RunControl& control) {
  check(states, problem);
  return Solver(states, problem, allowance, options, {}, control).run();
}

double bound_over_states(const StateTable& states, const PlacementProblem& problem,
                         const MissAllowance& allowance, double enough, const PlaceOptions& options,
                         const RunControl& control) {
  check(states, problem);
  return Solver(states, problem, allowance, options, enough, control).run().lower_bound;
}

}  // namespace shelfbeam
