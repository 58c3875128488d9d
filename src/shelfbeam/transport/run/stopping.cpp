#include "shelfbeam/transport/run/stopping.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace shelfbeam {

bool is_stopping_point(std::uint32_t batches) {
  std::uint64_t point = least_batches;
  while (point < batches) point += point / 16;
  return point == batches;
}

double relevance_limit(std::span<const double> means, double requirement, double share) {
  if (requirement > 0) return share * requirement;
  return means.empty() ? 0 : share * *std::max_element(means.begin(), means.end());
}

Standing standing(double mean, double standard_error, bool is_flagged, const RelativeError& wanted,
                  const Reachable& reachable) {
  const double most = wanted.error * mean;
  if (!is_flagged && standard_error <= most) return Standing::precise;
  const bool is_hopeless =
      (is_flagged && reachable.flags_are_final) || standard_error > most * reachable.error;
  return is_hopeless ? Standing::hopeless : Standing::open;
}

Precision count_precise(std::span<const double> means, std::span<const double> standard_errors,
                        std::span<const std::uint8_t> flags, double requirement, const RelativeError& wanted,
                        const Reachable& reachable) {
  const double limit = relevance_limit(means, requirement, wanted.above);
  Precision result;
  for (std::size_t k = 0; k < means.size(); ++k) {
    if (!(means[k] > limit)) continue;
    ++result.relevant;
    const Standing found = standing(means[k], standard_errors[k], flags[k] != 0, wanted, reachable);
    result.precise += found == Standing::precise ? 1 : 0;
    result.hopeless += found == Standing::hopeless ? 1 : 0;
  }
  return result;
}

double reachable_error(std::uint32_t batches, double growth) {
  constexpr double deviations = 3;
  return std::sqrt(growth) * (1 + deviations / std::sqrt(2.0 * (batches - 1)));
}

}  // namespace shelfbeam
