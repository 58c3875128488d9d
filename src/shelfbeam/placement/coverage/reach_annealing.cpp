#include "shelfbeam/placement/coverage/reach_annealing.hpp"

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "shelfbeam/placement/heuristic/annealing_walk.hpp"
#include "shelfbeam/placement/kernels/active_rows.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

namespace shelfbeam::detail {

namespace {

// The labels that walks work on; some weight of them may be missed.
class ReachRows {
 public:
  static constexpr std::uint64_t max_moves = 256;

  ReachRows(const SearchInstance& instance, const SearchMatrix& all, const LabelWeights& weights,
            double target, const Selection& start)
      : instance_(instance), weights_(weights), target_(target), rows_(all, receiving(instance.problem)) {
    rows_.add_hardest(start, ActiveRows::at_first);
  }

  std::size_t size() const { return rows_.size(); }
  std::size_t padded() const { return rows_.padded(); }
  const float* column(std::uint32_t j) const { return rows_.column(j); }

  // Excuses the rows that lack most for their weight.
  void excuse(std::vector<float>& held) {
    constexpr float excused = 64;
    short_of_.clear();
    for (std::uint32_t r = 0; r < rows_.size(); ++r)
      if (held[r] < 1)
        short_of_.emplace_back(
            static_cast<double>(1 - held[r]) / std::max(weights_[rows_.row(r)], least_weight), r);
    std::sort(short_of_.begin(), short_of_.end(), std::greater<>());
    double left = weights_.total() - target_;
    for (const auto& [lack, r] : short_of_) {
      const double weight = weights_[rows_.row(r)];
      if (weight > left) continue;
      left -= weight;
      held[r] += excused;
    }
  }

  bool reaches_all(const Selection& selected) {
    missed_ = check_selection(instance_.table, instance_.problem, selected).unmet;
    return weights_.without(missed_) >= target_;
  }

  bool add_missed() { return rows_.add(missed_); }

 private:
  static constexpr double least_weight = 1e-12;  // labels that count for nothing come first

  const SearchInstance& instance_;
  const LabelWeights& weights_;
  double target_;
  ActiveRows rows_;
  std::vector<std::pair<double, std::uint32_t>> short_of_;
  std::vector<std::uint32_t> missed_;
};

}  // namespace

std::optional<Selection> anneal_reach(const SearchInstance& instance, const SearchMatrix& all,
                                      const LabelWeights& weights, double target, const Selection& start,
                                      const Effort& effort, std::uint32_t seed, const RunControl& control) {
  return best_of_walks(seed, effort, control, [&](std::uint32_t own_seed) {
    return AnnealingWalk(instance, all, ReachRows(instance, all, weights, target, start), start, own_seed);
  });
}

}  // namespace shelfbeam::detail
