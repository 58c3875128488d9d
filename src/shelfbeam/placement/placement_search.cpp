#include "shelfbeam/placement/placement_search.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "shelfbeam/math/random.hpp"
#include "shelfbeam/placement/bound/lp_bound.hpp"
#include "shelfbeam/placement/heuristic/annealing.hpp"
#include "shelfbeam/placement/heuristic/cover_search.hpp"
#include "shelfbeam/placement/heuristic/local_search.hpp"
#include "shelfbeam/placement/kernels/search_matrix.hpp"
#include "shelfbeam/placement/kernels/search_problem.hpp"
#include "shelfbeam/placement/mip/export_model.hpp"
#include "shelfbeam/placement/mip/mip.hpp"
#include "shelfbeam/placement/problem/bounds.hpp"
#include "shelfbeam/placement/problem/checker.hpp"
#include "shelfbeam/placement/reduce/reduced_cover.hpp"
#include "shelfbeam/placement/reduce/reductions.hpp"
#include "shelfbeam/placement/tree/proof.hpp"
#include "shelfbeam/placement/tree/tree_search.hpp"

namespace shelfbeam::detail {

namespace {

using Clock = std::chrono::steady_clock;
using Selection = std::vector<std::uint32_t>;

// Values that differ by less are equal; sums of other orders differ by less.
constexpr double equal_values = 1e-9;

class Engine {
 public:
  Engine(const SignalTable& table, const Question& question, const Selection& start, const Solvers& solvers,
         double time_limit_s, const SearchLimits& limits, std::uint64_t seed, const RunControl& control)
      : table_(table),
        question_(question),
        solvers_(solvers),
        limits_(limits),
        progress_(*this, control.progress),
        control_{control.threads, control.cancel, control.progress == nullptr ? nullptr : &progress_},
        end_(after(std::clamp(time_limit_s, 0.0, 1e8))),
        problem_(table, question),
        first_cost_(first_objective(table, question)),
        bounds_(table, first_cost_),
        is_weighted_(question.combination == Combination::weighted),
        seed_(static_cast<std::uint32_t>(mix_key(seed, 0))) {
    const std::size_t places = table.rows() * table.columns();
    if (places <= limits.most_places_of_local_search) matrix_.emplace(table, question.model);
    if (places <= limits.most_places_of_trees) tree_.emplace(problem_, *matrix_);
    accept(start);
    bound_ = is_weighted_ ? bounds_.cheapest(least_count(table, question))
                          : static_cast<double>(least_count(table, question));
  }

  Placement run() {
    improve(is_plain_cover(table_, question_) || is_small() ? 1000 : 20000);
    untimed_ = best_;
    report();
    constexpr std::uint64_t nodes_of_a_first_look = 15000, nodes_of_a_second_look = 5000000;
    if (!closed() && is_small()) climb(part_of_rest(0.2), nodes_of_a_first_look);
    // Where neither a tree nor a MIP may follow, the bound is what takes the time.
    if (!closed()) bound_by_lp(part_of_rest(has_tree(best_.size()) || may_ask_mip() ? 0.5 : 0.7));
    // What reductions leave is often little, and then nothing is as fast; nor is anything for small models.
    if (!closed() && !is_small()) ask_mip(reduces() ? part_of_rest(0.3) : std::min(part_of_rest(0.15), 5.0));
    if (!closed() && is_small() && !reduces()) climb(part_of_rest(0.3), nodes_of_a_second_look);
    if (!closed()) improve(200000, after(std::min(part_of_rest(0.2), 20.0)));
    // Covers of many units are what MIP solvers are good at, once they are reduced, and trees are not.
    if (!closed() && (is_small() || !reduces())) climb(part_of_rest(is_small() ? 0.6 : 0.35));
    if (!closed() && (!is_small() || reduces())) ask_mip(part_of_rest(0.9));
    if (!closed()) climb(rest());
    if (!closed()) improve(std::numeric_limits<std::uint64_t>::max(), end_);

    bool is_optimal = closed();
    double lower = bound_;
    if (!is_weighted_ && question_.objective != Objective::count) {
      const std::vector<double> cost = objective_coefficients(table_, question_);
      const CostBounds second(table_, cost);
      lower = second.cheapest(static_cast<std::size_t>(bound_));
      if (is_optimal) is_optimal = cheapest_of_the_fewest(cost, second, lower);
    }
    if (is_optimal && limits_.settles_ties) settle_ties();
    Placement placement;
    placement.question = question_;
    placement.unit_costs = label_costs(table_, question_.objective).unit;
    placement.selected = best_;
    placement.objective_value = is_weighted_ || question_.objective != Objective::count
                                    ? value_of(best_)
                                    : static_cast<double>(best_.size());
    placement.lower_bound = std::min(lower, placement.objective_value);
    placement.count_lower_bound = is_weighted_
                                      ? static_cast<double>(std::max(least_count(table_, question_),
                                                                     bounds_.fewest(placement.lower_bound)))
                                      : bound_;
    placement.status = is_optimal ? Status::optimal : Status::stopped;
    placement.ties_settled = ties_settled_;
    placement.bound_proof = proof_;
    placement.solver = asked_.empty() ? "search" : "search with " + asked_;
    return placement;
  }

 private:
  // Whatever is at work, those who watch are told the best selection and the bound.
  class Progress : public ProgressSink {
   public:
    Progress(const Engine& engine, ProgressSink* sink) : engine_(engine), sink_(sink) {}
    void report(std::string_view stage, double, std::string_view detail) override {
      if (sink_ == nullptr) return;
      const std::string below = stage == task ? "" : fmt::format("; {}", stage);
      sink_->report(task, -1, fmt::format("{}{} {}", engine_.state(), below, detail));
    }

   private:
    const Engine& engine_;
    ProgressSink* sink_;
  };
  static constexpr std::string_view task = "placing";

  static Clock::time_point after(double seconds) {
    return Clock::now() +
           std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(std::max(seconds, 0.0)));
  }
  double rest() const { return std::chrono::duration<double>(end_ - Clock::now()).count(); }
  double part_of_rest(double part) const { return part * rest(); }
  bool out_of_time() const { return control_.cancelled() || rest() <= 0; }

  // The second objective (lexicographic), or the whole sum (weighted).
  double value_of(const Selection& selected) const {
    const Check check = check_selection(table_, question_, selected);
    return check.objective + (is_weighted_ ? check.transceiver_cost : 0);
  }
  bool closed() const { return solver_closed_ || best_value_ - bound_ <= equal_values * best_value_; }
  // A tree may end within seconds.
  bool is_small() const {
    return best_.size() <= limits_.small_answer && table_.entries.size() <= limits_.most_mip_entries;
  }
  // `reduce_cover` takes the question.
  bool reduces() const {
    return question_.model == CommunicationModel::non_cooperative && !question_.redundant;
  }

  bool may_ask_mip() const {
    return !solvers_.only_linear && (reduces() || table_.entries.size() <= limits_.most_mip_entries);
  }

  std::string state() const {
    const double gap = best_value_ > bound_ ? 100 * (best_value_ - bound_) / best_value_ : 0;
    return fmt::format("best {:.6g}, at least {:.6g}, gap {:.1f} %", best_value_, bound_, gap);
  }
  void report() const { control_.report(task, -1, {}); }

  // Every selection comes in here, and none without the checker. `best_value_` is what the first stage
  // minimises: the count, or the whole sum.
  bool accept(const Selection& selected) {
    const Check check = check_selection(table_, question_, selected);
    if (!check.met()) return false;
    best_ = selected;
    best_value_ = is_weighted_ ? check.objective + check.transceiver_cost : static_cast<double>(best_.size());
    return true;
  }
  void offer(const std::optional<Selection>& found) {
    if (!found) return;
    const double known = best_value_;
    const Selection before = best_;
    if (!accept(*found)) return;
    if (best_value_ >= known) {
      best_ = before;
      best_value_ = known;
    } else {
      report();
    }
  }

  // A bound above a selection that the checker accepts is wrong. A solver may err, and is not believed; what
  // we proved ourselves must not.
  void raise(double bound, BoundProof proof) {
    bound = bounds_.rounded(bound);
    if (!(bound > bound_)) return;
    if (bound > best_value_ * (1 + 1e-6)) {
      if (proof == BoundProof::solver) return;
      throw std::logic_error(
          fmt::format("a lower bound of {} contradicts a selection of {}", bound, best_value_));
    }
    bound_ = std::min(bound, best_value_);
    proof_ = proof;
    report();
  }

  void improve(std::uint64_t moves, Clock::time_point until = Clock::time_point::max()) {
    if (out_of_time()) return;
    constexpr std::uint64_t cover_moves = 10;  // in the time of one move of local search
    const std::uint64_t exchanges = is_small() ? 10 : 40;
    until = std::min(until, end_);
    if (is_plain_cover(table_, question_) && !is_small()) {
      moves = std::min(moves, std::numeric_limits<std::uint64_t>::max() / cover_moves) * cover_moves;
      offer(cover_search(table_, question_, reduction(), best_, {moves, until}, seed_, control_));
    } else if (matrix_ && can_anneal(question_)) {
      moves = std::min(moves, std::numeric_limits<std::uint64_t>::max() / exchanges) * exchanges;
      offer(anneal(problem_, *matrix_, best_, {moves, until}, seed_, control_));
    } else if (matrix_) {
      offer(local_search(problem_, *matrix_, best_, {moves, until}, seed_, control_));
    }
    seed_ += walks_at_once;  // from the same start the same numbers would lead the same way
  }

  const Reduction& reduction() {
    if (!reduction_) {
      std::vector<bool> pinned(table_.apart.empty() ? 0 : table_.columns(), false);
      for (const auto& [a, b] : table_.apart) pinned[a] = pinned[b] = true;
      reduction_ = reduce_cover(table_, question_, first_cost_, pinned, [this] { return out_of_time(); });
    }
    return *reduction_;
  }

  // Calls ask(back end) until one has an answer that can be relied on.
  template <class Ask>
  auto ask_in_turn(std::span<const milp::Backend> backends, Ask ask) {
    for (std::size_t k = 0;; ++k) {
      asked_ = fmt::format("{} {}", backends[k].name, backends[k].version);
      auto answer = ask(backends[k]);
      if (!answer.failed || k + 1 == backends.size()) return answer;
    }
  }

  void bound_by_lp(double seconds) {
    if (seconds <= 0 || out_of_time()) return;
    struct Relaxation : LpBound {
      bool failed = false;
    };
    const Clock::time_point until = after(seconds);
    const auto backends =
        table_.entries.size() > limits_.most_small_lp_entries ? solvers_.for_large_lp : solvers_.preferred;
    const Relaxation lp = ask_in_turn(backends, [&](const milp::Backend& backend) {
      const double left = std::chrono::duration<double>(until - Clock::now()).count();
      Relaxation relaxation;
      if (is_weighted_) {
        LpBoundOptions options;
        options.time_limit_s = left;
        relaxation = {lp_bound(table_, question_, first_cost_, backend, options, control_)};
        raise(relaxation.dual.bound, BoundProof::dual);
      } else {
        CountBound count = count_bound(table_, question_, backend, left, control_);
        raise(static_cast<double>(count.count), BoundProof::dual);
        relaxation = {std::move(count.relaxation)};
      }
      relaxation.failed = relaxation.rounds == 0 && !out_of_time();
      return relaxation;
    });
    begin_tree_with(lp);
    relaxation_ = lp.dual;
  }

  void begin_tree_with(const LpBound& lp) {
    std::vector<std::uint32_t> rows;
    std::vector<double> weights;
    for (std::size_t k = 0; k < lp.rows.size(); ++k) {
      if (!lp.rows[k].is_plain()) continue;
      rows.push_back(lp.rows[k].label);
      weights.push_back(lp.y[k]);
    }
    if (tree_ && !rows.empty()) tree_->begin_with(rows, weights);
  }

  // What an exhausted tree proves, once its log has been examined.
  std::optional<BoundProof> strength_of(const Proof& proof) const {
    if (proof.steps.size() > limits_.most_checked_steps) return BoundProof::search;
    switch (judge_proof(table_, question_, proof, {end_, control_})) {
      case ProofVerdict::holds:
        return BoundProof::log;
      case ProofVerdict::left_open:
      case ProofVerdict::unfinished:
        return BoundProof::search;
      case ProofVerdict::refuted:
        break;
    }
    return std::nullopt;  // whatever the search says, it has not shown it
  }

  bool has_tree(std::size_t units) const { return tree_ && units <= limits_.most_units_of_trees; }

  // From the bound upwards: is there a selection of so many units? The first that there is is the best.
  void climb(double seconds, std::uint64_t nodes = std::numeric_limits<std::uint64_t>::max()) {
    if (!has_tree(best_.size()) || out_of_time()) return;
    TreeSearch::Limits limits;
    limits.effort.until = after(seconds);
    limits.effort.steps = nodes;
    limits.wants_proof = true;
    if (is_weighted_) {
      TreeGoal goal;
      goal.kind = TreeGoal::Kind::cheapest;
      goal.most_units = bounds_.affordable(best_value_);
      if (!has_tree(goal.most_units)) return;
      goal.most_cost = clearly_less(problem_.cost_of(best_));
      const TreeAnswer answer = tree_->run(goal, limits, control_);
      offer(answer.selected);
      if (!answer.is_complete) return;
      if (const auto strength = strength_of(answer.proof))
        raise(surely(answer.proof.most_cost, goal.most_units), *strength);
      return;
    }
    while (!closed() && !control_.cancelled() && Clock::now() < limits.effort.until) {
      TreeGoal goal;
      goal.most_units = static_cast<std::size_t>(std::llround(bound_));
      const TreeAnswer answer = tree_->run(goal, limits, control_);
      offer(answer.selected);
      if (!answer.is_complete || answer.selected) break;
      const auto strength = strength_of(answer.proof);
      if (!strength) break;
      raise(bound_ + 1, *strength);
    }
  }

  // Units that no better selection has, by their reduced costs, and what such a selection costs at most.
  std::vector<std::uint32_t> useless_units(double& worth) const {
    const bool is_whole = bounds_.rounded(0.5) > 0.5;
    worth = is_whole ? best_value_ - 1 : best_value_ * (1 - equal_values);
    return relaxation_ ? useless_columns(*relaxation_, worth) : std::vector<std::uint32_t>{};
  }

  void ask_mip(double seconds) {
    if (out_of_time() || !may_ask_mip()) return;
    const Clock::time_point until = after(seconds);
    const auto left = [&] { return std::chrono::duration<double>(until - Clock::now()).count(); };
    if (reduces()) {
      double worth = 0;
      const std::vector<std::uint32_t> useless = useless_units(worth);
      const ReducedAnswer answer = ask_in_turn(solvers_.preferred, [&](const milp::Backend& backend) {
        return place_reduced(table_, question_, first_cost_, reduction(), useless, backend.solve, left(),
                             control_);
      });
      offer(answer.selected);
      // With a useless unit it costs more than `worth`.
      const double bound = useless.empty() ? answer.bound : std::min(answer.bound, next_above(worth));
      raise(bound, BoundProof::solver);
      if (answer.proven) close_by_solver(answer.selected);
    } else {
      Question first = question_;
      if (!is_weighted_) first.objective = Objective::count;
      const ReducedAnswer answer = ask_in_turn(solvers_.preferred, [&](const milp::Backend& backend) {
        const MipAnswer mip = place_by_mip(table_, first, best_, backend.solve, left(), control_);
        const Placement& placement = mip.placement;
        return ReducedAnswer{placement.selected, placement.lower_bound, placement.status == Status::optimal,
                             mip.solver_failed};
      });
      offer(answer.selected);
      raise(answer.bound, BoundProof::solver);
      if (answer.proven) close_by_solver(answer.selected);
    }
  }

  // Costs that are whole numbers leave nothing between.
  double next_above(double worth) const { return best_value_ - worth >= 0.5 ? best_value_ : worth; }

  // Solvers end at a gap of their own, which is wider than ours.
  void close_by_solver(const std::optional<Selection>& proven) {
    if (!proven || closed() || value_of_first(*proven) > best_value_ * (1 + equal_values)) return;
    solver_closed_ = true;
    if (!is_weighted_) bound_ = best_value_;
    proof_ = BoundProof::solver;
  }
  double value_of_first(const Selection& selected) const {
    return is_weighted_ ? value_of(selected) : static_cast<double>(selected.size());
  }

  // The second objective among the selections of the fewest units; whether its least value is proven.
  bool cheapest_of_the_fewest(const std::vector<double>& cost, const CostBounds& second, double& lower) {
    double value = value_of(best_);
    const auto is_closed = [&] { return value - lower <= equal_values * value; };
    const auto take = [&](const std::optional<Selection>& found) {
      if (!found || found->size() != best_.size()) return;
      const double other = value_of(*found);
      if (other < value && accept(*found)) value = other;
    };
    const auto lift = [&](double bound, BoundProof proof) {
      bound = second.rounded(bound);
      if (!(bound > lower)) return;
      lower = bound;
      rest_on(proof);
    };
    if (is_closed()) return true;
    if (!is_small()) {
      LpBoundOptions options;
      options.time_limit_s = part_of_rest(0.3);
      options.answers = {best_.size(), best_.size()};
      const LpBound lp = lp_bound(table_, question_, cost, solvers_.preferred.front(), options, control_);
      lift(lp.dual.bound, BoundProof::dual);
      begin_tree_with(lp);
      if (is_closed()) return true;
    }
    if (has_tree(best_.size()) && !out_of_time()) {
      TreeGoal goal;
      goal.kind = TreeGoal::Kind::cheapest;
      goal.most_units = best_.size();
      goal.most_cost = clearly_less(problem_.cost_of(best_));
      TreeSearch::Limits limits;
      limits.effort.until = after(part_of_rest(0.6));
      limits.wants_proof = true;
      const TreeAnswer answer = tree_->run(goal, limits, control_);
      take(answer.selected);
      if (answer.is_complete)
        if (const auto strength = strength_of(answer.proof))
          lift(surely(answer.proof.most_cost, goal.most_units), *strength);
      if (is_closed()) return true;
    }
    if (out_of_time() || solvers_.only_linear || table_.entries.size() > limits_.most_mip_entries)
      return false;
    const ReducedAnswer answer = ask_in_turn(solvers_.preferred, [&](const milp::Backend& backend) {
      return place_at_count(table_, question_, cost, best_, backend.solve, rest(), control_);
    });
    take(answer.selected);
    lift(answer.bound, BoundProof::solver);
    if (answer.proven) rest_on(BoundProof::solver);
    return answer.proven || is_closed();
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

  // Nothing dearer may win, but for what sums of prices such as 0.1 and 0.2 are off. Limited by work, and
  // from nothing that timing may have had a part in: the same for any number of threads, settled or not.
  void settle_ties() {
    const std::size_t most_units = is_weighted_ ? bounds_.affordable(best_value_) : best_.size();
    if (!has_tree(most_units) || out_of_time()) return;
    TreeGoal goal;
    goal.kind = TreeGoal::Kind::widest;
    goal.most_units = most_units;
    constexpr int bits_of_rounding = 40;  // 1e-12 of it
    if (problem_.has_costs) {
      goal.most_cost = problem_.cost_of(best_);
      goal.most_cost += goal.most_cost >> bits_of_rounding;
    }
    if (untimed_.size() <= most_units && problem_.cost_of(untimed_) <= goal.most_cost) goal.start = untimed_;
    TreeSearch::Limits limits;
    constexpr std::uint64_t most_work = 2'000'000'000;  // some tenths of a second
    limits.work = most_work;
    limits.effort.until = after(part_of_rest(0.5));
    TreeSearch tree(problem_, *matrix_);
    const TreeAnswer answer = tree.run(goal, limits, control_);
    if (answer.selected) accept(*answer.selected);
    ties_settled_ = answer.is_complete;
  }

  const SignalTable& table_;
  const Question& question_;
  const Solvers& solvers_;
  const SearchLimits& limits_;
  Progress progress_;
  RunControl control_;
  Clock::time_point end_;
  SearchProblem problem_;
  std::optional<SearchMatrix> matrix_;
  std::optional<TreeSearch> tree_;
  std::optional<Reduction> reduction_;
  std::optional<DualBound> relaxation_;
  std::vector<double> first_cost_;
  CostBounds bounds_;
  bool is_weighted_;
  Selection best_, untimed_;
  double best_value_ = std::numeric_limits<double>::infinity();
  double bound_ = 0;
  BoundProof proof_ = BoundProof::trivial;
  bool solver_closed_ = false;  ///< a solver says that its gap is closed
  bool ties_settled_ = false;
  std::string asked_;
  std::uint32_t seed_;
};

}  // namespace

std::optional<std::vector<std::uint32_t>> first_selection(const SignalTable& table, const Question& question,
                                                          const std::vector<std::uint32_t>& start,
                                                          double time_limit_s, std::uint64_t seed,
                                                          const RunControl& control,
                                                          const SearchLimits& limits) {
  if (table.rows() * table.columns() > limits.most_places_of_local_search) return std::nullopt;
  const SearchProblem problem(table, question);
  const SearchMatrix matrix(table, question.model);
  Effort effort;
  effort.steps = 5000;
  effort.until = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                    std::chrono::duration<double>(std::clamp(time_limit_s, 0.0, 1e8)));
  const auto own_seed = static_cast<std::uint32_t>(mix_key(seed, 1));
  const auto found = local_search(problem, matrix, start, effort, own_seed, control);
  return found && check_selection(table, question, *found).met() ? found : std::nullopt;
}

Placement search_placement(const SignalTable& table, const Question& question,
                           const std::vector<std::uint32_t>& start, const Solvers& solvers,
                           double time_limit_s, std::uint64_t seed, const RunControl& control,
                           const SearchLimits& limits) {
  const auto answer = [&](const SignalTable& asked) {
    return Engine(asked, question, start, solvers, time_limit_s, limits, seed, control).run();
  };
  const Check known = check_selection(table, question, start);
  const double most = 2 * (known.objective + known.transceiver_cost);
  const auto is_too_dear = [&](const SignalTable::Transceiver& unit) { return unit.cost > most; };
  if (question.combination == Combination::lexicographic || !(most > 0) ||
      std::none_of(table.transceivers.begin(), table.transceivers.end(), is_too_dear))
    return answer(table);
  // No answer as good as the known one has such a unit, at that price or less: so far off, it would only
  // drown the others' prices in its rounding.
  SignalTable cheaper = table;
  for (auto& unit : cheaper.transceivers) unit.cost = std::min(unit.cost, most);
  return answer(cheaper);
}

}  // namespace shelfbeam::detail
