#pragma once

#include <array>
#include <cstdint>

#include "shelfbeam/math/random.hpp"

namespace shelfbeam {

/// The first two dimensions of Sobol's sequence, scrambled as Owen has it by hashing (Laine and Karras 2011,
/// with the constants of Burley, "Practical hash-based Owen scrambling", JCGT 2020). Every point is uniform
/// on the unit square; any 2^k points from a multiple of 2^k on have one point in each of the 2^k boxes that
/// any way of halving the sides gives. Different keys give scramblings independent of each other.
class ScrambledSobol {
 public:
  explicit constexpr ScrambledSobol(std::uint64_t key)
      : key0_(static_cast<std::uint32_t>(key)), key1_(static_cast<std::uint32_t>(key >> 32)) {}

  constexpr std::array<double, 2> point(std::uint32_t index) const {
    // In the mirror image of the bits Owen's scrambling lets every bit depend on the lower ones alone.
    return {to_unit(reversed(hashed(index, key0_))), to_unit(reversed(hashed(second(index), key1_)))};
  }

 private:
  // The second coordinate's bits in mirror image; its direction numbers are the rows of Pascal's triangle
  // modulo 2, applied here to all bits at once.
  static constexpr std::uint32_t second(std::uint32_t index) {
    std::uint32_t x = index;
    x ^= (x & 0xAAAAAAAA) >> 1;
    x ^= (x & 0xCCCCCCCC) >> 2;
    x ^= (x & 0xF0F0F0F0) >> 4;
    x ^= (x & 0xFF00FF00) >> 8;
    x ^= x >> 16;
    return x;
  }
  static constexpr std::uint32_t hashed(std::uint32_t x, std::uint32_t key) {
    x ^= x * 0x3D20ADEA;
    x += key;
    x *= (key >> 16) | 1;
    x ^= x * 0x05526C56;
    x ^= x * 0x53A22864;
    return x;
  }
  static constexpr std::uint32_t reversed(std::uint32_t x) {
    x = ((x >> 1) & 0x55555555) | ((x & 0x55555555) << 1);
    x = ((x >> 2) & 0x33333333) | ((x & 0x33333333) << 2);
    x = ((x >> 4) & 0x0F0F0F0F) | ((x & 0x0F0F0F0F) << 4);
    x = ((x >> 8) & 0x00FF00FF) | ((x & 0x00FF00FF) << 8);
    return (x >> 16) | (x << 16);
  }

  std::uint32_t key0_, key1_;
};

}  // namespace shelfbeam
