#include "shelfbeam/device/direction_table.hpp"

#include "shelfbeam/device/direction_densities.hpp"
#include "shelfbeam/device/photometry/planes.hpp"

#include "support/testing.hpp"
#include "unit/device/profiles.hpp"

namespace shelfbeam::test {
namespace {

// Simpson's rule, exact to 1e-13 for these smooth integrands.
double simpson(const detail::SineSegment& s, double end) {
  constexpr int steps = 2000;
  double sum = 0;
  for (int k = 0; k <= steps; ++k) {
    const double theta = s.begin + (end - s.begin) * k / steps;
    const double f = s.first + (s.last - s.first) * (theta - s.begin) / (s.end - s.begin);
    sum += (k == 0 || k == steps ? 1 : k % 2 == 1 ? 4 : 2) * f * std::sin(theta);
  }
  return sum * (end - s.begin) / steps / 3;
}

const std::vector<detail::SineSegment> segments{
    {0, pi / 2, 1, 1}, {0, pi, 0, 3},       {0, 0.01, 2, 0},   {0, 0.01, 0, 2}, {1.5, 1.50001, 1, 5},
    {3.1, pi, 1, 0},   {0.3, 0.4, 1e-9, 4}, {0, 1e-6, 1, 0.5}, {0, pi, 1, 0},   {2, 3, 0, 1e-12}};

// Relative errors: 1e-12, and for the inverse also the rounding of theta, 1e-15 of the share's width. The
// control is an integral that is 1e-4 off.
TEST(SineSegment, IntegratesAndInvertsExactly) {
  for (const auto& s : segments) {
    const double total = s.integral();
    EXPECT_NEAR(total / simpson(s, s.end), 1, 1e-12);
    for (const double u : {0.001, 0.25, 0.5, 0.9}) {
      const double tolerance = 1e-12 + 1e-15 / (u * (s.end - s.begin));
      EXPECT_NEAR(simpson(s, s.invert(u * total)) / (u * total), 1, tolerance) << s.begin << " " << u;
      EXPECT_GT(simpson(s, s.invert(u * total * 1.0001)) / (u * total), 1 + 5e-5) << s.begin << " " << u;
    }
    EXPECT_EQ(s.invert(0), s.begin);
    EXPECT_EQ(s.invert(total), s.end);
  }
}

TEST(DirectionTable, RefusesInvalidTables) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(DirectionTable({0}, {0}, {1}), std::invalid_argument);
  EXPECT_THROW(DirectionTable({0, 0}, {0}, {1, 1}), std::invalid_argument);
  EXPECT_THROW(DirectionTable({0, 4}, {0}, {1, 1}), std::invalid_argument);
  EXPECT_THROW(DirectionTable({0, 1}, {0, 3}, {1, 1, 1, 1}), std::invalid_argument);
  EXPECT_THROW(DirectionTable({0, 1}, {0}, {1, 1, 1}), std::invalid_argument);
  EXPECT_THROW(DirectionTable({0, 1}, {0}, {1, -1}), std::invalid_argument);
  EXPECT_THROW(DirectionTable({0, 1}, {0}, {1, nan}), std::invalid_argument);
  EXPECT_THROW(DirectionTable({0, nan}, {0}, {1, 1}), std::invalid_argument);
  EXPECT_THROW(DirectionTable({0, 1}, {0}, {0, 0}).with_integral(1), std::invalid_argument);
}

TEST(DirectionTable, NeverSamplesZeroDensity) {
  const DirectionTable dark({0, 1}, {0}, {0, 0});
  EXPECT_FALSE(dark.sample(0.5, 0.5));
  EXPECT_EQ(dark.pdf({0, 0, 1}), 0);
}

TEST(DirectionTable, IsZeroOutsideItsThetas) {
  const DirectionTable ring(all_radians({30, 60}), {0}, {1, 2});
  EXPECT_EQ(value_at(ring, 29.9, 0), 0);
  EXPECT_NEAR(value_at(ring, 45, 200), 1.5, 1e-12);
  EXPECT_EQ(value_at(ring, 60.1, 0), 0);
}

// Angle intervals of subnormal width must not give NaN.
TEST(DirectionTable, HandlesNearlyEqualAngles) {
  const DirectionTable table({0, 1e-320, 1}, {0}, {1, 3, 1});
  EXPECT_NEAR(table.integral(), 2 * pi * (3 - std::cos(1.0) - 2 * std::sin(1.0)), 1e-12);
  EXPECT_TRUE(table.sample(0.5, 0.5));
}

// A smooth floodlight at steps of 5 degrees, narrower in y and tilted.
detail::TypeB floodlight() {
  detail::TypeB result;
  for (int v = -90; v <= 90; v += 5) result.vertical.push_back(v);
  for (int h = -90; h <= 90; h += 5) {
    detail::Plane plane{static_cast<double>(h), {}};
    for (const double v : result.vertical)
      plane.values.push_back(std::exp(-v * v / 800 - (h - 10) * (h - 10) / 200.0));
    result.horizontals.push_back(plane);
  }
  return result;
}

struct Difference {
  double worst = 0, flux = 0;
};

Difference difference(const detail::TypeB& source, const DirectionTable& table) {
  Difference result;
  constexpr int steps = 300;
  double sum = 0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < 4 * steps; ++j) {
      const double z = (i + 0.5) / steps, phi = 2 * pi * (j + 0.5) / (4 * steps),
                   across = std::sqrt(1 - z * z);
      const Vec3 d{across * std::cos(phi), across * std::sin(phi), z};
      result.worst = std::max(result.worst, std::abs(table.value(d) - source.value(d)));
      sum += source.value(d);
    }
  result.flux = table.integral() / (sum * 2 * pi / (4.0 * steps * steps)) - 1;
  return result;
}

// Errors relative to the peak, 1. Interpolating over the file's 5 degrees loses 0.03 (an eighth of the
// squared step times 1/100 per square degree). Resampling at 1 degree adds 0.0066 at the resulting kinks, and
// 2.7e-4 of the flux, as measured. Controls: the opposite sense of H, and H and V exchanged.
TEST(TypeB, ResamplingStaysWithinItsError) {
  const detail::TypeB source = floodlight();
  EXPECT_EQ(source.step(), 1);
  const Difference good = difference(source, source.resampled());
  EXPECT_LT(good.worst, 0.008);
  EXPECT_LT(std::abs(good.flux), 3e-4);

  detail::TypeB reversed = source, exchanged = source;
  for (std::size_t h = 0; h < source.horizontals.size(); ++h) {
    reversed.horizontals[h].values = source.horizontals[source.horizontals.size() - 1 - h].values;
    for (std::size_t v = 0; v < source.vertical.size(); ++v)
      exchanged.horizontals[h].values[v] = source.horizontals[v].values[h];
  }
  EXPECT_GT(difference(source, reversed.resampled()).worst, 0.3);
  EXPECT_GT(difference(source, exchanged.resampled()).worst, 0.3);
}

TEST(TypeB, FineFilesAreResampledFiner) {
  detail::TypeB source = floodlight();
  source.vertical.insert(source.vertical.begin() + 1, -89);
  for (detail::Plane& plane : source.horizontals) plane.values.insert(plane.values.begin() + 1, 0.0);
  EXPECT_EQ(source.step(), 0.5);
  EXPECT_EQ(source.resampled().theta().size(), 181u);
}

}  // namespace
}  // namespace shelfbeam::test
