#pragma once

#include "shelfbeam/transport/world/path_rules.hpp"

namespace shelfbeam {

// Multiple importance sampling (2.7.3; Veach 1997, chapter 9). If each technique k draws n_k samples of the
// same paths, with densities p_k in one measure, a sample x of technique i contributes
//
//     w_i f(x) / (n_i p_i),        w_i = (n_i p_i)^b / sum_k (n_k p_k)^b,            (2.19)
//
// with all p_k at x. The weights of a path sum to 1 over the techniques, so the estimate is unbiased.

/// w_i for two techniques: `own` is n_i p_i, `other` is n_k p_k of the other technique.
inline double mis_weight(Heuristic heuristic, double own, double other) {
  const double ratio = other / own;
  return 1 / (1 + (heuristic == Heuristic::power ? ratio * ratio : ratio));
}

/// The balance heuristic for any number of techniques. The weight cancels the density of the technique that
/// sampled x, so x contributes f(x) / sum_k n_k p_k for every technique.
class BalanceHeuristic {
 public:
  /// Adds n_k p_k of a technique.
  void add(double density) { sum_ += density; }
  bool can_be_drawn() const { return sum_ > 0; }
  double estimate(double f) const { return f / sum_; }

 private:
  double sum_ = 0;
};

}  // namespace shelfbeam
