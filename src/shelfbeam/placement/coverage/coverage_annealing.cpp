#include "shelfbeam/placement/coverage/coverage_annealing.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "shelfbeam/placement/heuristic/annealing_walk.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

namespace shelfbeam::detail {

namespace {

enum class Aim { fewest_units, most_weight };

// All labels. A selection lacks the missed weight beyond the weight that may be missed.
class WeighedRows {
 public:
  static constexpr std::uint64_t max_moves = 4096;

  WeighedRows(const Instance& instance, const ActiveRows& rows, const LabelWeights& weights, double target,
              std::size_t units, Aim aim)
      : instance_(instance),
        rows_(rows),
        weights_(weights),
        target_(aim == Aim::fewest_units ? target : target_above(target)),
        aim_(aim),
        weight_(rows.padded(), 0.0F),
        heat_(target_ / static_cast<double>(std::max<std::size_t>(1, units)) * scale()) {
    for (std::size_t r = 0; r < rows.size(); ++r)
      weight_[r] = static_cast<float>(weights[rows.row(r)] * scale());
  }

  std::size_t size() const { return rows_.size(); }
  std::size_t padded() const { return rows_.padded(); }
  const float* column(std::uint32_t j) const { return rows_.column(j); }
  void excuse(std::vector<float>&, const std::vector<float>&) const {}

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
    if (aim_ == Aim::fewest_units) return true;
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
  double scale() const { return static_cast<double>(rows_.size()) / weights_.total(); }

  const Instance& instance_;
  const ActiveRows& rows_;
  const LabelWeights& weights_;
  double target_;
  Aim aim_;
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
  return best_of_walks(seed, effort, control, [&](std::uint32_t own_seed) {
    WeighedRows weighed(instance_, rows_, weights_, target, start.size(), Aim::fewest_units);
    return AnnealingWalk(instance_, matrix_, std::move(weighed), start, own_seed);
  });
}

std::optional<Selection> CoverageAnnealing::for_more(double reached, const Selection& start,
                                                     const Effort& effort, std::uint32_t seed,
                                                     const RunControl& control) const {
  struct Walk {
    AnnealingWalk<WeighedRows> walk;
    void run(const Effort& of_one, const RunControl& own) { walk.run(of_one, own); }
    Found best() const { return walk.rows().best(); }
  };
  if (!(weights_.total() > 0)) return {};
  return best_of_walks(seed, effort, control, [&](std::uint32_t own_seed) {
    WeighedRows weighed(instance_, rows_, weights_, reached, start.size(), Aim::most_weight);
    return Walk{AnnealingWalk(instance_, matrix_, std::move(weighed), start, own_seed)};
  });
}

}  // namespace shelfbeam::detail
