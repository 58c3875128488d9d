#include "shelfbeam/placement/coverage/coverage_annealing.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "shelfbeam/placement/heuristic/annealing_walk.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

namespace shelfbeam::detail {

namespace {

// All labels. A selection lacks the missed weight beyond the weight that may be missed.
class WeighedRows {
 public:
  static constexpr std::uint64_t max_moves = 4096;

  WeighedRows(const Instance& instance, const ActiveRows& rows, const LabelWeights& weights, double target,
              std::size_t units, bool raises)
      : instance_(instance),
        rows_(rows),
        weights_(weights),
        target_(raises ? target_above(target) : target),
        raises_(raises),
        weight_(rows.padded(), 0.0F),
        heat_(target_ / static_cast<double>(std::max<std::size_t>(1, units)) * scale()) {
    for (std::size_t r = 0; r < rows.rows(); ++r)
      weight_[r] = static_cast<float>(weights[rows.row(r)] * scale());
  }

  const ActiveRows& matrix() const { return rows_; }

  // About 5 % of the moves are accepted at the hot end, few at the cold end.
  double hot() const { return 0.07 * heat_; }
  double cold() const { return 0.007 * heat_; }

  float lack_after(const SearchKernels::Held& held, const float* out, const float* in, float demand) const {
    const auto allowed = static_cast<float>((weights_.total() - target_) * scale() + rounding);
    return SearchKernels::missed_after(held, out, in, demand, weight_.data(), rows_.padded()) - allowed;
  }

  bool reaches_all(const Selection& selected) {
    is_raised_ = false;
    const double reached = weights_.without(instance_.check(selected).unmet);
    if (reached < target_) return false;
    if (!raises_) return true;
    best_ = {selected, -reached};
    target_ = target_above(reached);
    is_raised_ = true;
    return false;
  }
  bool add_missed() const { return is_raised_; }

  const Found& best() const { return best_; }

 private:
  static constexpr double rounding = 1e-4;  // of single precision, in mean weights

  // Less than the rounding cannot be told apart.
  double target_above(double reached) const {
    return reached + std::max(weights_.step(), 2 * rounding / scale());
  }

  // The mean weight becomes 1, which keeps counts exact in single precision.
  double scale() const { return static_cast<double>(rows_.rows()) / weights_.total(); }

  const Instance& instance_;
  const ActiveRows& rows_;
  const LabelWeights& weights_;
  double target_;
  bool raises_;  // the target: the most weight is sought
  std::vector<float> weight_;
  double heat_;  // the weight that a unit reaches
  bool is_raised_ = false;
  Found best_;  // with the most weight
};

}  // namespace

bool CoverageAnnealing::fits(const Instance& instance) {
  constexpr std::size_t max_cells = 100'000'000;
  return instance.rows() * instance.columns() <= max_cells;
}

CoverageAnnealing::CoverageAnnealing(const Instance& instance, const LabelWeights& weights)
    : instance_(instance), matrix_(instance), rows_(matrix_, receiving(instance.problem)), weights_(weights) {
  rows_.add_all();
}

std::optional<Selection> CoverageAnnealing::for_fewer(double target, const Selection& start,
                                                      const Effort& effort, std::uint32_t seed,
                                                      const RunControl& control) const {
  if (!(target > 0)) return {};
  return best(target, false, start, effort, seed, control);
}

std::optional<Selection> CoverageAnnealing::for_more(double reached, const Selection& start,
                                                     const Effort& effort, std::uint32_t seed,
                                                     const RunControl& control) const {
  if (!(weights_.total() > 0)) return {};
  return best(reached, true, start, effort, seed, control);
}

std::optional<Selection> CoverageAnnealing::best(double target, bool raises, const Selection& start,
                                                 const Effort& effort, std::uint32_t seed,
                                                 const RunControl& control) const {
  return best_of_walks(seed, effort, control, [&](std::uint32_t own_seed) {
    WeighedRows weighed(instance_, rows_, weights_, target, start.size(), raises);
    return AnnealingWalk(instance_, matrix_, std::move(weighed), start, own_seed);
  });
}

}  // namespace shelfbeam::detail
