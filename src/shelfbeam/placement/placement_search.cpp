#include "shelfbeam/placement/detail/placement_search.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "shelfbeam/placement/bounds.hpp"
#include "shelfbeam/placement/checker.hpp"
#include "shelfbeam/placement/detail/cover_search.hpp"
#include "shelfbeam/placement/detail/local_search.hpp"
#include "shelfbeam/placement/detail/lp_bound.hpp"
#include "shelfbeam/placement/detail/proof.hpp"
#include "shelfbeam/placement/detail/reduced_cover.hpp"
#include "shelfbeam/placement/detail/search_matrix.hpp"
#include "shelfbeam/placement/detail/search_problem.hpp"
#include "shelfbeam/placement/detail/tree_search.hpp"
#include "shelfbeam/placement/export_model.hpp"
#include "shelfbeam/placement/mip.hpp"

namespace shelfbeam::detail {

namespace {

using Clock = std::chrono::steady_clock;
using Selection = std::vector<std::uint32_t>;

// Answers of more units than this are beyond the tree.
constexpr std::size_t most_units_of_trees = 40;
// Models of more entries than this are beyond a MIP solver in the time that planners have.
constexpr std::size_t most_mip_entries = 400000;
constexpr std::size_t most_checked_steps = 1000000;
// Tables of more entries have linear programs that are large, too.
constexpr std::size_t most_small_lp_entries = 5000000;

class Engine {
 public:
  Engine(const SignalTable& table, const Question& question, Selection start, const milp::Backend& backend,
         double time_limit_s, const RunControl& control, const milp::Backend* for_large_lp)
      : table_(table),
        question_(question),
        backend_(backend),
        lp_backend_(for_large_lp && table.entries.size() > most_small_lp_entries ? *for_large_lp : backend),
        control_(control),
        begin_(Clock::now()),
        end_(begin_ + std::chrono::duration_cast<Clock::duration>(
                          std::chrono::duration<double>(std::clamp(time_limit_s, 0.0, 1e8)))),
        problem_(table, question),
        matrix_(table, question.model),
        tree_(problem_, matrix_),
        first_cost_(first_objective(table, question)),
        bounds_(table, first_cost_),
        best_(std::move(start)) {
    is_weighted_ = question.combination == Combination::weighted;
    bound_ = is_weighted_ ? bounds_.cheapest(least_count(table, question))
                          : static_cast<double>(least_count(table, question));
  }

  Placement run() {
    improve(is_plain_cover(table_, question_) || is_small() ? 1000 : 20000);
    report();
    constexpr std::uint64_t nodes_of_a_first_look = 200000;
    if (!closed() && is_small()) climb(part_of_rest(0.2), nodes_of_a_first_look);
    if (!closed()) bound_by_lp(part_of_rest(0.5));
    // What reductions leave is often little, and then nothing is as fast.
    if (!closed() && reduces()) hand_over_to_mip(0.3);
    if (!closed()) improve(200000, until(part_of_rest(0.2)));
    // Covers of many units are what MIP solvers are good at, once they are reduced, and trees are not.
    if (!closed() && (is_small() || !reduces())) climb(is_small() ? part_of_rest(0.6) : part_of_rest(0.35));
    if (!closed()) hand_over_to_mip(0.9);
    if (!closed()) climb(rest());
    if (!closed()) improve(std::numeric_limits<std::uint64_t>::max(), end_);

    Placement placement;
    placement.question = question_;
    placement.unit_costs = label_costs(table_, question_.objective).unit;
    bool is_optimal = closed();
    if (is_weighted_) {
      if (is_optimal && is_small()) settle_ties();
      placement.objective_value = value_of(best_);
      placement.lower_bound =
          is_optimal ? placement.objective_value : std::min(bound_, placement.objective_value);
      placement.count_lower_bound = static_cast<double>(
          std::max(least_count(table_, question_), bounds_.fewest(placement.lower_bound)));
    } else {
      placement.count_lower_bound = bound_;
      placement.objective_value = static_cast<double>(best_.size());
      placement.lower_bound = bound_;
      if (question_.objective != Objective::count) {
        const std::vector<double> cost = objective_coefficients(table_, question_);
        const CostBounds second(table_, cost);
        double lower = second.cheapest(static_cast<std::size_t>(bound_));
        if (is_optimal) is_optimal = cheapest_of_the_fewest(cost, second, lower);
        if (is_optimal) settle_ties();
        placement.objective_value = value_of(best_);
        placement.lower_bound =
            std::min(is_optimal ? placement.objective_value : lower, placement.objective_value);
      } else if (is_optimal) {
        settle_ties();
      }
    }
    placement.status = is_optimal ? Status::optimal : Status::stopped;
    placement.ties_settled = ties_settled_;
    placement.bound_proof = proof_;
    placement.selected = best_;
    placement.solver = asked_.empty() ? "search" : "search with " + asked_;
    return placement;
  }

 private:
  double rest() const { return std::chrono::duration<double>(end_ - Clock::now()).count(); }
  double part_of_rest(double part) const { return part * rest(); }
  Clock::time_point until(double seconds) const {
    return Clock::now() +
           std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(std::max(seconds, 0.0)));
  }
  bool out_of_time() const { return control_.cancelled() || rest() <= 0; }

  // What the first stage minimises: the count, or the whole sum.
  double first_value(const Selection& selected) const {
    if (!is_weighted_) return static_cast<double>(selected.size());
    return value_of(selected);
  }
  double value_of(const Selection& selected) const {
    const Check check = check_selection(table_, question_, selected);
    return check.objective + (is_weighted_ ? check.transceiver_cost : 0);
  }
  bool closed() const {
    const double value = first_value(best_);
    return value - bound_ <= 1e-9 * value;
  }
  // A tree may end within seconds.
  bool is_small() const { return best_.size() <= 9 && table_.entries.size() <= most_mip_entries; }

  void report() const {
    control_.report("placing", -1, fmt::format("{:.6g}, at least {:.6g}", first_value(best_), bound_));
  }

  void raise(double bound, BoundProof proof) {
    bound = bounds_.rounded(bound);
    if (!(bound > bound_) || !std::isfinite(bound)) return;  // a selection is known: nothing is infeasible
    bound_ = std::min(bound, first_value(best_));
    proof_ = proof;
    report();
  }

  void offer(const std::optional<Selection>& found) {
    if (!found || !check_selection(table_, question_, *found).met()) return;
    if (first_value(*found) >= first_value(best_)) return;
    best_ = *found;
    report();
  }

  void improve(std::uint64_t moves, Clock::time_point until = Clock::time_point::max()) {
    if (out_of_time()) return;
    constexpr std::uint32_t walks = 2;
    constexpr std::uint64_t cover_moves = 10;  // for one of the other kind
    if (is_plain_cover(table_, question_) && !is_small()) {
      moves = std::min(moves, std::numeric_limits<std::uint64_t>::max() / cover_moves) * cover_moves;
      offer(cover_search(table_, question_, best_, {moves, walks, std::min(until, end_), seed_}, control_));
    } else {
      offer(local_search(problem_, matrix_, best_, {moves, walks, std::min(until, end_), seed_}, control_));
    }
    seed_ += walks;  // from the same start the same numbers would lead the same way
  }

  void bound_by_lp(double seconds) {
    if (seconds <= 0 || control_.cancelled()) return;
    asked_ = fmt::format("{} {}", lp_backend_.name, lp_backend_.version);
    LpBound lp;
    if (is_weighted_) {
      LpBoundOptions options;
      options.time_limit_s = seconds;
      lp = lp_bound(table_, question_, first_cost_, lp_backend_, options, control_);
      raise(lp.dual.bound, BoundProof::dual);
    } else {
      CountBound count = count_bound(table_, question_, lp_backend_, seconds, control_);
      raise(static_cast<double>(count.count), BoundProof::dual);
      lp = std::move(count.relaxation);
    }
    std::vector<std::uint32_t> rows;
    std::vector<double> weights;
    for (std::size_t k = 0; k < lp.rows.size(); ++k) {
      if (!lp.rows[k].taken.empty() || lp.rows[k].share > 0) continue;
      rows.push_back(lp.rows[k].label);
      weights.push_back(lp.y[k]);
    }
    if (rows.empty()) return;
    tree_.begin_with(rows, weights);
  }

  bool proof_holds(const Proof& proof) const {
    return proof.is_complete && proof.steps.size() <= most_checked_steps &&
           check_proof(table_, question_, proof);
  }

  // From the bound upwards: is there a selection of so many units? The first that there is is the best.
  void climb(double seconds, std::uint64_t nodes = std::numeric_limits<std::uint64_t>::max()) {
    if (best_.size() > most_units_of_trees || table_.rows() * table_.columns() > std::size_t{20000000})
      return;
    TreeSearch::Limits limits;
    limits.until = until(seconds);
    limits.nodes = nodes;
    limits.wants_proof = true;
    if (is_weighted_) {
      TreeGoal goal;
      goal.kind = TreeGoal::Kind::cheapest;
      goal.most_units = affordable(value_of(best_));
      if (goal.most_units > most_units_of_trees) return;
      goal.most_cost = clearly_less(problem_.cost_of(best_));
      const TreeAnswer answer = tree_.run(goal, limits, control_);
      offer(answer.selected);
      if (answer.is_complete)
        raise(surely(answer.proof.most_cost, goal.most_units),
              proof_holds(answer.proof) ? BoundProof::log : BoundProof::search);
      return;
    }
    while (!closed() && !control_.cancelled() && Clock::now() < limits.until) {
      TreeGoal goal;
      goal.most_units = static_cast<std::size_t>(std::llround(bound_));
      const TreeAnswer answer = tree_.run(goal, limits, control_);
      offer(answer.selected);
      if (!answer.is_complete || answer.selected) break;
      raise(bound_ + 1, proof_holds(answer.proof) ? BoundProof::log : BoundProof::search);
    }
  }

  // Most units of a selection that costs no more.
  std::size_t affordable(double cost) const {
    std::vector<double> ascending;
    double spent = 0;
    for (std::size_t j = 0; j < first_cost_.size(); ++j)
      if (table_.transceivers[j].installed)
        spent += first_cost_[j];
      else
        ascending.push_back(first_cost_[j]);
    std::sort(ascending.begin(), ascending.end());
    std::size_t count = problem_.installed.size();
    for (const double one : ascending) {
      spent += one;
      if (spent > cost * (1 + 1e-9)) break;
      ++count;
    }
    return count;
  }

  // `place_reduced` takes the question.
  bool reduces() const {
    return question_.model == CommunicationModel::non_cooperative && !question_.redundant;
  }

  void hand_over_to_mip(double part) {
    if (out_of_time()) return;
    if (reduces()) {
      asked_ = fmt::format("{} {}", backend_.name, backend_.version);
      const ReducedAnswer answer =
          place_reduced(table_, question_, first_cost_, backend_, part_of_rest(part), control_);
      offer(answer.selected);
      raise(answer.bound, BoundProof::solver);
    } else if (table_.entries.size() <= most_mip_entries && !is_small()) {
      mip(part_of_rest(0.7));
    }
  }

  void mip(double seconds) {
    asked_ = fmt::format("{} {}", backend_.name, backend_.version);
    Question first = question_;
    if (!is_weighted_) first.objective = Objective::count;
    const MipAnswer answer = place_by_mip(table_, first, best_, backend_.solve, seconds, control_);
    offer(answer.placement.selected);
    raise(answer.placement.lower_bound, BoundProof::solver);
  }

  // The second objective among the selections of the fewest units; whether its least value is proven.
  bool cheapest_of_the_fewest(const std::vector<double>& cost, const CostBounds& second, double& lower) {
    constexpr double proof_gap = 1e-9;
    const auto is_closed = [&] { return value_of(best_) - lower <= proof_gap * value_of(best_); };
    if (is_closed()) return true;
    TreeGoal goal;
    goal.kind = TreeGoal::Kind::cheapest;
    goal.most_units = best_.size();
    goal.most_cost = clearly_less(problem_.cost_of(best_));
    TreeSearch::Limits limits;
    limits.until = until(part_of_rest(0.6));
    limits.wants_proof = true;
    if (best_.size() <= most_units_of_trees) {
      const TreeAnswer answer = tree_.run(goal, limits, control_);
      if (answer.selected && value_of(*answer.selected) < value_of(best_)) best_ = *answer.selected;
      if (answer.is_complete) {
        lower = std::max(lower, second.rounded(surely(answer.proof.most_cost, goal.most_units)));
        rest_on(proof_holds(answer.proof) ? BoundProof::log : BoundProof::search);
        if (is_closed()) return true;
      }
    }
    if (out_of_time() || table_.entries.size() > most_mip_entries) return false;
    asked_ = fmt::format("{} {}", backend_.name, backend_.version);
    const auto at_fewest = place_at_count(table_, question_, cost, best_, backend_.solve, rest(), control_);
    if (at_fewest.selected && value_of(*at_fewest.selected) < value_of(best_)) best_ = *at_fewest.selected;
    if (const double bound = second.rounded(at_fewest.bound); at_fewest.proven || bound > lower) {
      lower = std::max(lower, bound);
      rest_on(BoundProof::solver);
    }
    return at_fewest.proven || is_closed();
  }

  // Both bounds of an answer rest on the weaker of two proofs.
  void rest_on(BoundProof proof) { proof_ = std::max(proof_, proof); }

  // Sums that differ by rounding are not worth a search.
  static std::int64_t clearly_less(std::int64_t cost) { return cost - std::max<std::int64_t>(1, cost >> 33); }

  // What costs more than `most` units of cost, rounded for every column.
  double surely(std::int64_t most, std::size_t units) const {
    return std::max(
        0.0, (static_cast<double>(most) + 1 - static_cast<double>(units + 1) / 2) * problem_.cost_unit);
  }

  void settle_ties() {
    if (best_.size() > most_units_of_trees || out_of_time()) return;
    TreeGoal goal;
    goal.kind = TreeGoal::Kind::widest;
    goal.most_units = is_weighted_ ? affordable(value_of(best_)) : best_.size();
    if (goal.most_units > most_units_of_trees) return;
    constexpr int bits_of_tolerance = 30;  // 1e-9 of it
    if (problem_.has_costs) {
      goal.most_cost = problem_.cost_of(best_);
      goal.most_cost += goal.most_cost >> bits_of_tolerance;
    }
    goal.start = best_;
    TreeSearch::Limits limits;
    // No longer than all before, but for a second.
    const double before = std::chrono::duration<double>(Clock::now() - begin_).count();
    limits.until = until(std::min(std::clamp(before, 1.0, 5.0), part_of_rest(0.5)));
    const TreeAnswer answer = tree_.run(goal, limits, control_);
    if (answer.selected) best_ = *answer.selected;
    ties_settled_ = answer.is_complete;
  }

  const SignalTable& table_;
  const Question& question_;
  const milp::Backend &backend_, &lp_backend_;
  const RunControl& control_;
  Clock::time_point begin_, end_;
  SearchProblem problem_;
  SearchMatrix matrix_;
  TreeSearch tree_;
  std::vector<double> first_cost_;
  CostBounds bounds_;
  bool is_weighted_ = false;
  Selection best_;
  double bound_ = 0;
  BoundProof proof_ = BoundProof::trivial;
  bool ties_settled_ = false;
  std::string asked_;
  std::uint32_t seed_ = 1;
};

}  // namespace

Placement search_placement(const SignalTable& table, const Question& question,
                           const std::vector<std::uint32_t>& start, const milp::Backend& backend,
                           double time_limit_s, const RunControl& control,
                           const milp::Backend* for_large_lp) {
  const Check known = check_selection(table, question, start);
  const double most = 2 * (known.objective + known.transceiver_cost);
  const auto is_too_dear = [&](const SignalTable::Transceiver& unit) { return unit.cost > most; };
  if (question.combination == Combination::lexicographic || !(most > 0) ||
      std::none_of(table.transceivers.begin(), table.transceivers.end(), is_too_dear))
    return Engine(table, question, start, backend, time_limit_s, control, for_large_lp).run();
  // No answer as good as the known one has such a unit, at that price or less: so far off, it would only
  // drown the others' prices in its rounding.
  SignalTable cheaper = table;
  for (auto& unit : cheaper.transceivers) unit.cost = std::min(unit.cost, most);
  return Engine(cheaper, question, start, backend, time_limit_s, control, for_large_lp).run();
}

}  // namespace shelfbeam::detail
