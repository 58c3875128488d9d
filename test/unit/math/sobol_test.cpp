#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/math/random.hpp"

#include "support/hypothesis.hpp"

namespace shelfbeam {
namespace {

using Point = std::array<double, 2>;

// Whether each box contains one of 2^k points, for all ways to halve the sides k times.
bool fills_every_box(const std::vector<Point>& points) {
  const std::size_t n = points.size();
  for (std::size_t across = 1; across <= n; across *= 2) {
    const std::size_t up = n / across;
    std::vector<int> counts(n);
    for (const auto& [x, y] : points)
      ++counts[static_cast<std::size_t>(x * static_cast<double>(across)) * up +
               static_cast<std::size_t>(y * static_cast<double>(up))];
    for (const int count : counts)
      if (count != 1) return false;
  }
  return true;
}

template <class Draw>
std::vector<Point> points(std::uint32_t first, std::uint32_t n, const Draw& draw) {
  std::vector<Point> result;
  for (std::uint32_t k = first; k < first + n; ++k) result.push_back(draw(k));
  return result;
}

// Exact. The controls are random points, the same net shifted cyclically in the square, and 2^k points that
// do not begin at a multiple of 2^k.
TEST(ScrambledSobol, HasAPointInEveryElementaryBox) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const ScrambledSobol square(mix_key(seed, 3));
    const auto draw = [&](std::uint32_t k) { return square.point(k); };
    for (std::uint32_t n = 1; n <= 512; n *= 2)
      for (const std::uint32_t first : {0U, n, 5 * n, 1000003 * n})
        ASSERT_TRUE(fills_every_box(points(first, n, draw))) << seed << ": " << n << " from " << first;

    const auto random = [&](std::uint32_t k) {
      const auto u = philox({k, 0, 0, 0}, seed);
      return Point{to_uniform(u[0]), to_uniform(u[1])};
    };
    EXPECT_FALSE(fills_every_box(points(0, 32, random)));
    const auto by = random(1000);
    const auto shifted = [&](std::uint32_t k) {
      const auto [x, y] = square.point(k);
      return Point{std::fmod(x + by[0], 1.0), std::fmod(y + by[1], 1.0)};
    };
    EXPECT_FALSE(fills_every_box(points(0, 128, shifted)));
    EXPECT_FALSE(fills_every_box(points(37, 128, draw)));
  }
}

// z-tests at 0.1 % over 40,000 keys, of means and mean products of centred coordinates: of one point, of
// neighbours under one key, and of nets under different keys, which must be independent. Errors of 0.0014 and
// 0.0004. The controls are one key for both nets, and coordinates that are 0.01 too large.
TEST(ScrambledSobol, IsUniformAndIndependentOverKeys) {
  constexpr std::uint32_t keys = 40000, most = 6;
  std::vector<double> means, products, same_key;
  for (std::uint32_t index = 0; index < most; ++index)
    for (std::size_t d = 0; d < 2; ++d) {
      double mean = 0, own = 0;
      std::array<double, 2> product{};
      for (std::uint32_t k = 0; k < keys; ++k) {
        const ScrambledSobol one(mix_key(mix_key(7, k), 0)), other(mix_key(mix_key(7, k), 1));
        const double x = one.point(index)[d] - 0.5;
        mean += x;
        product[0] += x * (other.point(index)[d] - 0.5);
        product[1] += x * (one.point(index)[1 - d] - 0.5);
        own += x * (one.point(index)[d] - 0.5);
      }
      means.push_back(mean / keys);
      for (const double p : product) products.push_back(p / keys);
      same_key.push_back(own / keys);
    }
  const auto agrees = [](const std::vector<double>& values, double error, double reference = 0) {
    return z_test(values, std::vector<double>(values.size(), reference),
                  std::vector<double>(values.size(), error / std::sqrt(keys)), 0.001)
        .pass;
  };
  EXPECT_TRUE(agrees(means, std::sqrt(1.0 / 12)));
  EXPECT_FALSE(agrees(means, std::sqrt(1.0 / 12), 0.01));
  EXPECT_TRUE(agrees(products, 1.0 / 12));
  EXPECT_FALSE(agrees(same_key, 1.0 / 12));
}

}  // namespace
}  // namespace shelfbeam
