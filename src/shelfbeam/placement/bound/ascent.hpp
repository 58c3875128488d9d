#pragma once

#include <cstddef>
#include <limits>

namespace shelfbeam::detail {

/// How steps become shorter when the value no longer rises.
struct StepRule {
  double first = 1;          ///< length of the first step
  double shorter = 0.7;      ///< factor after every `patience` steps without a gain
  std::size_t patience = 1;  ///< steps, at least 1
  std::size_t max_idle =
      std::numeric_limits<std::size_t>::max();  ///< steps without a gain that end the ascent
};

/// Maximises a concave function of multipliers, such as a Lagrangian bound, by steps along subgradients.
/// `Dual` knows the present multipliers and has
///
///   bool ends(std::size_t step)          before each step, from 1: the effort is over, or enough is reached
///   bool move(double length)             takes a step; false if there is no direction left
///   double evaluate(std::size_t step)    the value after it; the dual keeps the best multipliers
///   double least_gain(double value)      optional: by which a value must exceed this one to count as a gain
///   void shorten()                       optional: after steps have become shorter
///
/// `value` is that of the first multipliers. Returns the length of the next step.
template <class Dual>
double ascend(Dual& dual, double value, const StepRule& rule) {
  double length = rule.first;
  std::size_t idle = 0;
  for (std::size_t step = 1; idle < rule.max_idle && !dual.ends(step) && dual.move(length); ++step) {
    const double found = dual.evaluate(step);
    double gain = 0;
    if constexpr (requires { dual.least_gain(value); }) gain = dual.least_gain(value);
    const bool is_better = found > value + gain;
    if (is_better) value = found;
    idle = is_better ? 0 : idle + 1;
    if (idle == 0 || idle % rule.patience != 0) continue;
    length *= rule.shorter;
    if constexpr (requires { dual.shorten(); }) dual.shorten();
  }
  return length;
}

}  // namespace shelfbeam::detail
