#pragma once

#include "shelfbeam/transport/world/path_rules.hpp"

namespace shelfbeam {

// Multiple importance sampling (2.7.3; Veach 1997, chapter 9). Where techniques k draw n_k samples each of
// the same paths, with densities p_k in one measure, a sample x that technique i has drawn counts
//
//     w_i f(x) / (n_i p_i),        w_i = (n_i p_i)^b / sum_k (n_k p_k)^b,            (2.19)
//
// all p_k at x. The weights of a path sum to 1 over the techniques, so the estimate has no bias.

/// w_i of one of two techniques, from its density and that of the other, each times its number of samples.
inline double mis_weight(Heuristic heuristic, double own, double other) {
  const double ratio = other / own;
  return 1 / (1 + (heuristic == Heuristic::power ? ratio * ratio : ratio));
}

/// The balance heuristic of any number of techniques: the weight cancels the density of the technique that
/// has drawn x, so whichever it was, x counts f(x) / sum_k n_k p_k.
class BalanceHeuristic {
 public:
  /// n_k p_k of another technique.
  void add(double density) { sum_ += density; }
  bool can_be_drawn() const { return sum_ > 0; }
  double estimate(double f) const { return f / sum_; }

 private:
  double sum_ = 0;
};

}  // namespace shelfbeam
