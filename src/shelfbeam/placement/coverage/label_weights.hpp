#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam {

/// The table gives its labels weights other than 1.
bool has_weights(const SignalTable& table);

namespace detail {

/// The weights of the labels in a unit in which they are whole, if they have at most six decimals. Then all
/// sums of them are exact, and bounds can be rounded down. Other weights keep their unit.
class LabelWeights {
 public:
  explicit LabelWeights(const SignalTable& table);

  double operator[](std::size_t label) const { return weight_[label]; }
  std::span<const double> of_labels() const { return weight_; }
  double total() const { return total_; }
  bool are_whole() const { return whole_; }
  /// Less than this between two sums counts as equal: 1, or 1e-9 of the total if the weights are not whole.
  double step() const { return whole_ ? 1 : 1e-9 * total_; }

  /// The weight of the labels whose element is true.
  double sum(const std::vector<bool>& reached) const;
  /// The weight of all labels but these (ascending).
  double without(const std::vector<LabelId>& missed) const;
  /// An upper bound on a sum of weights, rounded down if they are whole. Relative errors up to 1e-9 of the
  /// bound itself are allowed for.
  double rounded_down(double bound) const;
  /// A lower bound on a sum of weights, rounded up if they are whole. It forgives 1e-9 of itself.
  double rounded_up(double bound) const;
  /// A sum in the unit of the table.
  double in_table(double sum) const { return sum / scale_; }

 private:
  std::vector<double> weight_;
  double scale_ = 1, total_ = 0;
  bool whole_ = false;
};

/// The labels that some selection reaches, regardless of the other labels.
std::vector<bool> reachable_labels(const detail::Instance& instance);
/// Their weight, which no selection exceeds.
double reachable_weight(const detail::Instance& instance, const LabelWeights& weights);

}  // namespace detail

}  // namespace shelfbeam
