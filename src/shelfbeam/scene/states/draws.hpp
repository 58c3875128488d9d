#pragma once

#include <cmath>
#include <cstdint>
#include <string_view>

#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/math/warp.hpp"

namespace shelfbeam {

/// A number rounded to a multiple of 1 / `parts`, so that mathematical libraries that differ in the last bit
/// give the same states.
inline double rounded(double value, double parts) {
  return std::round(value * parts) / parts;
}

/// The random numbers of one thing in one state. They depend on nothing else.
class Draws {
 public:
  Draws(std::uint64_t seed, std::uint64_t state, std::string_view thing)
      : key_(mix_key(mix_key(seed, state), hash64(thing))) {}

  std::uint32_t bits(std::uint32_t index) const { return philox({index, 0, 0, 0}, key_)[0]; }
  /// In [0, 1).
  double uniform(std::uint32_t index) const { return to_uniform(bits(index)); }
  /// Normally distributed with standard deviation 1 (Box, Muller 1958), rounded.
  double normal(std::uint32_t index) const {
    const auto [a, b, c, d] = philox({index, 1, 0, 0}, key_);
    const double radius = std::sqrt(-2 * std::log(1 - to_uniform(a)));
    return rounded(radius * std::cos(2 * pi * to_uniform(b)), 1e6);
  }

 private:
  std::uint64_t key_;
};

}  // namespace shelfbeam
