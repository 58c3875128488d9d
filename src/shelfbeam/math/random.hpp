#pragma once

#include <array>
#include <cstdint>

namespace shelfbeam {

/// Philox4x32-10 (Salmon, Moraes, Dror, Shaw: "Parallel random numbers: as easy as 1, 2, 3", SC 2011): a
/// bijection of a 128-bit counter under a 64-bit key. Different counters give independent numbers, so a value
/// depends only on its purpose, not on the thread or the time of the call.
constexpr std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::uint64_t key) {
  auto k0 = static_cast<std::uint32_t>(key);
  auto k1 = static_cast<std::uint32_t>(key >> 32);
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t a = std::uint64_t{0xD2511F53} * counter[0];
    const std::uint64_t b = std::uint64_t{0xCD9E8D57} * counter[2];
    counter = {static_cast<std::uint32_t>(b >> 32) ^ counter[1] ^ k0, static_cast<std::uint32_t>(b),
               static_cast<std::uint32_t>(a >> 32) ^ counter[3] ^ k1, static_cast<std::uint32_t>(a)};
    k0 += 0x9E3779B9;
    k1 += 0xBB67AE85;
  }
  return counter;
}

/// Converts 32 random bits to a uniform random number in [0, 1).
constexpr double to_uniform(std::uint32_t bits) {
  return bits * 0x1p-32;
}

/// Converts 32 random bits to a uniform index in {0, ..., n-1}; the bias is below n / 2^32.
constexpr std::uint32_t to_index(std::uint32_t bits, std::uint32_t n) {
  return static_cast<std::uint32_t>((std::uint64_t{bits} * n) >> 32);
}

/// Combines a seed with the identity of a stream (splitmix64's finaliser).
constexpr std::uint64_t mix_key(std::uint64_t seed, std::uint64_t stream) {
  std::uint64_t z = seed + 0x9E3779B97F4A7C15 * (stream + 1);
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
  return z ^ (z >> 31) ^ stream;
}

/// The first two dimensions of the Sobol sequence with hash-based Owen scrambling (Laine and Karras 2011,
/// with the constants of Burley, "Practical hash-based Owen scrambling", JCGT 2020). Every point is uniform
/// on the unit square. If its sides are halved into 2^k boxes, 2^k points from a multiple of 2^k on put one
/// point into each box. Different keys give independent scramblings.
class ScrambledSobol {
 public:
  explicit constexpr ScrambledSobol(std::uint64_t key)
      : key0_(static_cast<std::uint32_t>(key)), key1_(static_cast<std::uint32_t>(key >> 32)) {}

  constexpr std::array<double, 2> point(std::uint32_t index) const {
    // With the bits reversed, Owen scrambling makes every bit depend only on the lower bits.
    return {to_uniform(reversed(hashed(index, key0_))), to_uniform(reversed(hashed(second(index), key1_)))};
  }

 private:
  // The bits of the second coordinate in reverse order. Its direction numbers are the rows of Pascal's
  // triangle modulo 2, applied to all bits at once.
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
