#include "shelfbeam/placement/curve.hpp"

#include <algorithm>

#include "shelfbeam/placement/checker.hpp"
#include "shelfbeam/placement/detail/reach_search.hpp"
#include "shelfbeam/placement/reach_bound.hpp"

namespace shelfbeam {

namespace {

// Entries looked at, so that answers do not depend on the machine.
constexpr std::size_t search_work = 8'000'000'000;
constexpr std::size_t bound_work = 10'000'000'000;

class Curve {
 public:
  Curve(const SignalTable& table, const Question& question, const std::vector<std::uint32_t>& selected,
        const RunControl& control)
      : table_(table), question_(question), control_(control), search_(table, question) {
    const std::size_t first = std::max<std::size_t>(1, search_.count());
    for (std::size_t k = first; k <= selected.size(); ++k) points_.push_back({k, 0, table.rows()});
  }

  std::vector<CurvePoint> points(const std::vector<std::uint32_t>& selected) {
    if (points_.empty()) return {};
    look_forwards();
    look_backwards(selected);
    for (std::size_t p = 1; p < points_.size(); ++p)
      points_[p].at_least = std::max(points_[p].at_least, points_[p - 1].at_least);
    bound();
    return points_;
  }

 private:
  // What a search reaches is told by the checker.
  void offer(const std::vector<std::uint32_t>& selected) {
    const Check check = check_selection(table_, question_, selected);
    if (!check.allowed() || selected.size() > points_.back().units) return;
    const std::size_t place = std::max(selected.size(), points_.front().units) - points_.front().units;
    points_[place].at_least = std::max(points_[place].at_least, table_.rows() - check.unmet.size());
  }

  // One number of units after the other, each from the selection before, and exchanges as long as the share
  // of the work lasts.
  void look_forwards() {
    const std::size_t work = search_work / points_.size();
    for (const CurvePoint& point : points_) {
      if (control_.cancelled()) return;
      control_.report("curve",
                      static_cast<double>(point.units) / static_cast<double>(2 * points_.back().units));
      search_.improve(point.units, work, control_);
      offer(search_.selected());
    }
  }

  void look_backwards(const std::vector<std::uint32_t>& selected) {
    search_.start(selected);
    offer(selected);
    while (!control_.cancelled() && search_.count() > points_.front().units && search_.drop())
      offer(search_.selected());
  }

  void bound() {
    ReachBound bound(table_, question_, points_.back().units);
    const std::size_t all_steps = bound_work / (2 * bound.entries() + 1);
    const std::size_t steps = std::min<std::size_t>(300, 1 + all_steps / points_.size());
    for (const CurvePoint& point : points_) {
      control_.report("curve",
                      0.5 + static_cast<double>(point.units) / static_cast<double>(2 * points_.back().units));
      bound.improve(point.units, point.at_least, steps, control_);
    }
    for (CurvePoint& point : points_) point.at_most = bound.labels(point.units);
  }

  const SignalTable& table_;
  const Question& question_;
  const RunControl& control_;
  detail::ReachSearch search_;
  std::vector<CurvePoint> points_;
};

}  // namespace

std::vector<CurvePoint> reach_curve(const SignalTable& table, const Question& question,
                                    const std::vector<std::uint32_t>& selected, const RunControl& control) {
  return Curve(table, question, selected, control).points(selected);
}

}  // namespace shelfbeam
