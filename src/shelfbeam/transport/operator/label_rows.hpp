#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/transport/cache/lane_kernels.hpp"
#include "shelfbeam/transport/operator/operator_kernels.hpp"

namespace shelfbeam {

/// Weights of the labels of a cluster, by row (a point, or the points in a cell): groups of sixteen labels,
/// without the groups that have no weight. Packed by PackedLane.
class LabelRows {
 public:
  static constexpr std::size_t group = OperatorKernels::group,
                               max_labels = group * OperatorKernels::max_groups;

  std::size_t size() const { return masks_.size(); }

  /// Adds a row with a weight for each label.
  void add(std::span<const float> weights) {
    first_.push_back(static_cast<std::uint32_t>(weights_.size() / group));
    std::uint8_t mask = 0;
    for (std::size_t begin = 0; begin < weights.size(); begin += group) {
      const auto some = weights.subspan(begin, std::min(group, weights.size() - begin));
      if (std::all_of(some.begin(), some.end(), [](float weight) { return weight == 0; })) continue;
      mask = static_cast<std::uint8_t>(mask | (1U << (begin / group)));
      for (std::size_t k = 0; k < group; ++k)
        weights_.push_back(PackedLane::pack(k < some.size() ? some[k] : 0));
    }
    masks_.push_back(mask);
  }

  /// sums[c] += weight[c] value for each of the rows and its value; squares[c] += (weight[c] deviation)^2
  /// with its deviation. Both sums have max_labels elements.
  void add_to(std::span<const std::uint32_t> rows, std::span<const float> values, float* sums) const {
    OperatorKernels::add_rows(pointers(), rows.data(), values.data(), rows.size(), sums);
  }
  void add_to(std::span<const std::uint32_t> rows, std::span<const float> values,
              std::span<const float> deviations, float* sums, float* squares) const {
    OperatorKernels::add_rows(pointers(), rows.data(), values.data(), deviations.data(), rows.size(), sums,
                              squares);
  }

  /// Calls use(vector) for everything that a file needs.
  template <class Rows, class Use>
  static void each_part(Rows& rows, const Use& use) {
    use(rows.masks_);
    use(rows.first_);
    use(rows.weights_);
  }

  /// Whether the parts are those of some rows.
  bool fit() const {
    if (masks_.size() != first_.size()) return false;
    for (std::size_t row = 0; row < masks_.size(); ++row) {
      const auto groups = static_cast<std::size_t>(std::popcount(masks_[row]));
      if (masks_[row] >> OperatorKernels::max_groups != 0 || (first_[row] + groups) * group > weights_.size())
        return false;
    }
    return true;
  }

  void shrink_to_fit() {
    masks_.shrink_to_fit();
    first_.shrink_to_fit();
    weights_.shrink_to_fit();
  }
  std::size_t bytes() const {
    return masks_.size() * (sizeof(masks_[0]) + sizeof(first_[0])) + weights_.size() * sizeof(weights_[0]);
  }

 private:
  OperatorKernels::Rows pointers() const { return {masks_.data(), first_.data(), weights_.data()}; }

  std::vector<std::uint8_t> masks_;   // by row: its groups
  std::vector<std::uint32_t> first_;  // by row: its first weight, over `group`
  std::vector<std::uint16_t> weights_;
};

}  // namespace shelfbeam
