#pragma once

#include <array>
#include <cstddef>

namespace shelfbeam {

/// A smooth function of a cosine, from 0 to 1, as the polynomial through seven points of it, in Newton's
/// form: vectorised code evaluates it where a table would be slow.
struct CosineCurve {
  static constexpr std::size_t nodes = 7;
  using Values = std::array<float, nodes>;
  /// The cosines of these points, Chebyshev's: cos^2((k + 1/2) pi / 14).
  static constexpr Values at{0.98746396F, 0.89091574F, 0.71694187F, 0.50000000F,
                             0.28305813F, 0.10908426F, 0.01253604F};

  template <class Function>
  static CosineCurve through(const Function& function) {
    std::array<double, nodes> difference{};
    for (std::size_t k = 0; k < nodes; ++k) difference[k] = function(static_cast<double>(at[k]));
    for (std::size_t order = 1; order < nodes; ++order)
      for (std::size_t k = nodes - 1; k >= order; --k)
        difference[k] = (difference[k] - difference[k - 1]) / static_cast<double>(at[k] - at[k - order]);
    CosineCurve curve;
    for (std::size_t k = 0; k < nodes; ++k) curve.factor[k] = static_cast<float>(difference[k]);
    return curve;
  }

  Values factor{};
};

}  // namespace shelfbeam
