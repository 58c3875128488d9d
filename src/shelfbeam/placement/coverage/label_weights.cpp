#include "shelfbeam/placement/coverage/label_weights.hpp"

#include <algorithm>
#include <cmath>

#include "shelfbeam/placement/problem/mounts.hpp"

namespace shelfbeam {

bool has_weights(const SignalTable& table) {
  return std::any_of(table.labels.begin(), table.labels.end(),
                     [](const SignalTable::Label& label) { return label.weight != 1; });
}

namespace detail {

LabelWeights::LabelWeights(const SignalTable& table) {
  constexpr double max_scale = 1e6, max_exact = 9e15, rounding = 1e-12;
  double total = 0;
  for (const SignalTable::Label& label : table.labels) total += label.weight;
  // A decimal fraction is not exact, and its product with the scale is off by a part in 1e16.
  const auto is_whole = [&](double scale) {
    return std::all_of(table.labels.begin(), table.labels.end(), [&](const SignalTable::Label& label) {
      const double scaled = label.weight * scale;
      return std::abs(scaled - std::round(scaled)) <= rounding * scaled;
    });
  };
  for (double scale = 1; scale <= max_scale && total * scale < max_exact && !whole_; scale *= 10)
    if (is_whole(scale)) {
      whole_ = true;
      scale_ = scale;
    }
  for (const SignalTable::Label& label : table.labels) {
    weight_.push_back(whole_ ? std::round(label.weight * scale_) : label.weight);
    total_ += weight_.back();
  }
}

double LabelWeights::sum(const std::vector<bool>& reached) const {
  double result = 0;
  for (std::size_t i = 0; i < weight_.size(); ++i)
    if (reached[i]) result += weight_[i];
  return result;
}

double LabelWeights::without(const std::vector<LabelId>& missed) const {
  std::vector<bool> reached(weight_.size(), true);
  for (const LabelId i : missed) reached[i] = false;
  return sum(reached);
}

double LabelWeights::rounded_down(double bound) const {
  constexpr double error = 1e-9;
  const double safe = bound * (1 + error) + (whole_ ? error : 0);
  return std::min(total_, whole_ ? std::floor(safe) : safe);
}

double LabelWeights::rounded_up(double bound) const {
  constexpr double error = 1e-9;
  const double forgiving = bound * (1 - error);
  return whole_ ? std::ceil(forgiving) : forgiving;
}

std::vector<bool> reachable_labels(const detail::Instance& instance) {
  const Mounts& mounts = instance.mounts;
  std::vector<bool> result(instance.rows());
  for (std::size_t i = 0; i < instance.rows(); ++i)
    result[i] = mounts.may_meet(instance.row(i), instance.requirement(i), instance.problem);
  return result;
}

double reachable_weight(const detail::Instance& instance, const LabelWeights& weights) {
  return weights.rounded_down(weights.sum(reachable_labels(instance)));
}

}  // namespace detail

}  // namespace shelfbeam
