#include "shelfbeam/placement/coverage/coverage_curve.hpp"

#include <algorithm>

#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/placement/coverage/coverage_annealing.hpp"
#include "shelfbeam/placement/coverage/coverage_bound.hpp"
#include "shelfbeam/placement/coverage/coverage_effort.hpp"
#include "shelfbeam/placement/coverage/coverage_enumeration.hpp"
#include "shelfbeam/placement/coverage/least_useful.hpp"
#include "shelfbeam/placement/heuristic/greedy.hpp"
#include "shelfbeam/placement/kernels/walks.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

namespace shelfbeam {

namespace {

// Work in entries examined, so that results do not depend on the machine.
constexpr std::size_t bound_work = 10'000'000'000;

using Clock = std::chrono::steady_clock;

class Curve {
 public:
  Curve(const detail::Instance& instance, const Selection& selected, const RunControl& control,
        Clock::time_point until)
      : instance_(instance), control_(control), effort_{.until = until}, weights_(instance.table) {
    curve_.selected = selected;
    const std::size_t first = std::max<std::size_t>(1, instance.installed.size());
    for (std::size_t k = first; k <= selected.size(); ++k)
      points_.push_back({.units = k, .at_most = weights_.total(), .best = {}});
  }

  CoverageCurve run(const Selection& selected) {
    if (points_.empty()) return curve_;
    offer(selected);
    look_forwards();
    look_backwards(selected);
    anneal(detail::brief_annealing(instance_.table) / 10, part_of_rest(effort_, 4));
    rise();
    bound();
    enumerate();
    anneal(long_walk, effort_);
    rise();
    for (const Point& point : points_) curve_.points.push_back(in_table(point));
    curve_.is_complete = !was_cut_short_ && !is_over();
    return curve_;
  }

 private:
  static constexpr std::uint64_t long_walk = 30'000;  ///< moves of annealing per count

  /// Weights in the unit of LabelWeights.
  struct Point {
    std::size_t units = 0;
    std::size_t labels = 0;
    double at_least = 0, at_most = 0;
    Selection best;
    BoundProof miss_proof = BoundProof::dual;
  };

  bool is_over() const { return effort_.is_over(control_); }

  bool is_cut_short(const detail::Effort& part) {
    const bool is_late = part.is_over(control_);
    was_cut_short_ = was_cut_short_ || is_late;
    return is_late;
  }

  static detail::Effort part_of_rest(const detail::Effort& effort, int parts) {
    return detail::for_seconds(effort.seconds_left() / parts);
  }

  // The checker counts the labels that a selection reaches.
  void offer(const Selection& selected) {
    const Check check = instance_.check(selected);
    if (!check.allowed() || selected.size() > points_.back().units) return;
    Point& point = points_[std::max(selected.size(), points_.front().units) - points_.front().units];
    point.labels = std::max(point.labels, instance_.rows() - check.unmet.size());
    if (const double reached = weights_.without(check.unmet); reached > point.at_least) {
      point.at_least = reached;
      point.best = selected;
    }
    if (check.unmet.empty() && selected.size() < curve_.selected.size()) curve_.selected = selected;
  }

  // More units reach no less.
  void rise() {
    for (std::size_t p = 1; p < points_.size(); ++p) {
      points_[p].labels = std::max(points_[p].labels, points_[p - 1].labels);
      points_[p].at_least = std::max(points_[p].at_least, points_[p - 1].at_least);
    }
  }

  // The units that a greedy selection adds first.
  void look_forwards() {
    const detail::Effort end = part_of_rest(effort_, 4);
    const auto order = greedy_order(instance_, weights_.of_labels(), end, control_);
    is_cut_short(end);
    for (const Point& point : points_) {
      if (is_over()) return;
      report(0, point);
      offer(detail::first_units(order, point.units));
    }
  }

  // The given selection without its least useful units.
  void look_backwards(Selection selected) {
    while (!is_over() && selected.size() > points_.front().units) {
      const auto least = detail::least_useful(instance_, weights_, selected);
      if (!least) return;
      std::erase(selected, least->column);
      offer(selected);
    }
  }

  // Better selections for the counts whose bounds differ.
  void anneal(std::uint64_t moves, const detail::Effort& end) {
    const bool is_open = std::any_of(points_.begin(), points_.end(),
                                     [](const Point& point) { return point.at_least < point.at_most; });
    if (!is_open || !detail::CoverageAnnealing::fits(instance_)) return;
    const detail::CoverageAnnealing annealing(instance_, weights_);
    for (const Point& point : points_) {
      if (is_cut_short(end)) return;
      if (point.best.size() != point.units || point.at_least >= point.at_most) continue;
      const auto found = annealing.for_more(point.at_least, point.best, {moves, end.until}, seed_, control_);
      if (found) offer(*found);
      seed_ += detail::walks_at_once;
    }
  }

  void bound() {
    CoverageBound bound(instance_, weights_, points_.back().units);
    std::size_t steps = bound_work / (2 * bound.entries() + 1), points = points_.size();
    const detail::Effort last = part_of_rest(effort_, 2);
    for (const Point& point : points_) {
      if (is_over()) break;
      report(0.5, point);
      const detail::Effort end = part_of_rest(last, static_cast<int>(points));
      steps -= bound.improve(point.units, point.at_least, CoverageAim::lowest, {steps / points, end.until},
                             control_);
      is_cut_short(end);
      --points;
    }
    for (Point& point : points_) point.at_most = bound.weight(point.units);
  }

  // The first counts, as far as the work suffices; the last point reaches everything.
  void enumerate() {
    detail::CoverageTable dense(instance_, weights_);
    detail::Effort left{detail::enumeration_work, effort_.until};
    for (Point& point : points_) {
      rise();
      if (point.at_least >= point.at_most) continue;
      const auto found = enumerate_coverage(dense, weights_, point.units, point.at_least + weights_.step(),
                                            detail::EnumerationAim::best, left, control_);
      if (found.selected) offer(*found.selected);
      if (!found.is_complete) return;
      rise();
      const auto strength = judged(instance_, weights_, found.proof, point.units,
                                   point.at_least + weights_.step(), part_of_rest(effort_, 4), control_);
      was_cut_short_ = was_cut_short_ || !strength;
      if (!strength) return;
      if (point.at_most >= weights_.total()) point.miss_proof = *strength;
      point.at_most = std::min(point.at_most, point.at_least + (weights_.are_whole() ? 0 : weights_.step()));
    }
  }

  void report(double before, const Point& point) const {
    control_.report(Task::curve, before + static_cast<double>(point.units) /
                                              static_cast<double>(2 * points_.back().units));
  }

  CurvePoint in_table(const Point& point) const {
    CurvePoint result{.units = point.units, .at_least = point.labels, .miss_proof = point.miss_proof};
    if (has_weights(instance_.table)) {
      result.at_most =
          instance_.rows() - (point.at_most < weights_.total() && point.labels < instance_.rows() ? 1 : 0);
      result.weight = {weights_.in_table(point.at_least), weights_.in_table(point.at_most)};
    } else {
      result.at_most = static_cast<std::size_t>(point.at_most);
    }
    return result;
  }

  const detail::Instance& instance_;
  const RunControl& control_;
  detail::Effort effort_;
  detail::LabelWeights weights_;
  CoverageCurve curve_;
  std::uint32_t seed_ = 1;
  std::vector<Point> points_;
  bool was_cut_short_ = false;
};

}  // namespace

CoverageCurve coverage_curve(const SignalTable& table, const PlacementProblem& problem,
                             const Selection& selected, const RunControl& control, Clock::time_point until) {
  const ThreadLimit allowed(control.threads);
  const detail::Instance instance(table, detail::counting(problem));
  return Curve(instance, selected, control, until).run(selected);
}

void reconcile_bounds(Placement& placement, CoverageCurve& curve, const SignalTable& table,
                      bool selection_stays) {
  const PlacementProblem& problem = placement.problem;
  const bool is_lexicographic = problem.combination == Combination::lexicographic;
  const bool only_counts = is_lexicographic && problem.objective == Objective::count;
  if (is_lexicographic && !selection_stays && curve.selected.size() < placement.count()) {
    placement.selected = curve.selected;
    placement.objective_value = only_counts ? static_cast<double>(placement.count())
                                            : check_selection(table, problem, curve.selected).objective;
    placement.ties_settled = false;
    if (placement.price) placement.price = price_of(table, curve.selected);
    std::erase_if(curve.points, [&](const CurvePoint& point) { return point.units > placement.count(); });
  }
  for (const CurvePoint& point : curve.points) {
    const auto needed = static_cast<double>(point.units + 1);
    if (point.at_most == table.rows() || needed <= placement.count_lower_bound) continue;
    placement.count_lower_bound = needed;
    if (only_counts) placement.lower_bound = needed;
    placement.bound_proof =
        only_counts ? point.miss_proof : std::max(placement.bound_proof, point.miss_proof);
  }
  const bool is_proven = only_counts && placement.lower_bound >= placement.objective_value;
  if (is_proven) placement.status = Status::optimal;
  for (CurvePoint& point : curve.points)
    if (static_cast<double>(point.units) < placement.count_lower_bound)
      point.at_most = std::min(point.at_most, table.rows() - 1);
}

CoverageCurve add_curve(Placement& placement, const SignalTable& table, double time_limit_s,
                        const RunControl& control, bool selection_stays) {
  const Stopwatch watch;
  const double seconds = std::max(time_limit_s - placement.seconds, 0.1 * time_limit_s);
  CoverageCurve curve =
      coverage_curve(table, placement.problem, placement.selected, control, Deadline(seconds).end());
  reconcile_bounds(placement, curve, table, selection_stays);
  placement.seconds += watch.seconds();
  return curve;
}

}  // namespace shelfbeam
