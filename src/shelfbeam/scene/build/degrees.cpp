#include "shelfbeam/scene/build/degrees.hpp"

#include <bit>
#include <cmath>
#include <cstdint>

#include "shelfbeam/math/warp.hpp"

namespace shelfbeam {

double degrees_of(double angle) {
  const double near = std::round(angle * 180 / pi * 1e6) / 1e6;
  if (radians(near) == angle) return near;
  // `radians` rounds but never descends, and the bits of positive numbers ascend as the numbers do: the least
  // angle that reaches this one is found by halving.
  auto low = std::bit_cast<std::uint64_t>(0.0), high = std::bit_cast<std::uint64_t>(361.0);
  while (low < high) {
    const std::uint64_t middle = low + (high - low) / 2;
    if (radians(std::bit_cast<double>(middle)) < angle)
      low = middle + 1;
    else
      high = middle;
  }
  return std::bit_cast<double>(low);
}

}  // namespace shelfbeam
