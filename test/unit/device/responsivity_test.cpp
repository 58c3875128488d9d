#include "shelfbeam/device/responsivity.hpp"

#include "support/testing.hpp"
#include "unit/device/profiles.hpp"

namespace shelfbeam::test {
namespace {

double at_degrees(const Responsivity& r, double theta_deg) {
  return response(r, std::cos(radians(theta_deg)));
}

TEST(Responsivity, HasTheValuesOfItsDefinition) {
  EXPECT_NEAR(at_degrees(CosineResponse{}, 60), 0.5, 1e-15);
  const Responsivity narrow = CosinePowerResponse{3, radians(50)};
  EXPECT_NEAR(at_degrees(narrow, 45), std::pow(0.5, 1.5), 1e-15);
  EXPECT_GT(at_degrees(narrow, 49.999), 0);
  EXPECT_EQ(at_degrees(narrow, 50.001), 0);
  const Responsivity table = ResponseTable{{all_radians({0, 20, 40, 75}), {0}, {1, 0.9, 0.3, 0.1}}};
  EXPECT_NEAR(at_degrees(table, 0), 1, 1e-8);
  EXPECT_NEAR(at_degrees(table, 30), 0.6, 1e-12);
  EXPECT_NEAR(at_degrees(table, 57.5), 0.2, 1e-12);
  EXPECT_EQ(at_degrees(table, 76), 0);
}

TEST(Responsivity, PowerOneIsTheCosine) {
  for (int k = 0; k < 25; ++k)
    EXPECT_NEAR(at_degrees(CosinePowerResponse{1}, 7.3 * k), at_degrees(CosineResponse{}, 7.3 * k), 1e-16)
        << k;
  EXPECT_NEAR(integral(CosinePowerResponse{1}), integral(CosineResponse{}), 1e-15);
}

TEST(Responsivity, IsZeroFromBehind) {
  for (const auto& [name, r] : responses()) {
    EXPECT_EQ(at_degrees(r, 90.001), 0) << name;
    EXPECT_EQ(at_degrees(r, 180), 0) << name;
    EXPECT_EQ(pdf(r, {0, 0, -1}), 0) << name;
  }
}

// pi for the cosine (irradiance in a field of radiance 1), 2 pi / (p + 1) for a power; a cut-off at 60
// degrees removes a quarter of the cosine's integral.
TEST(Responsivity, IntegralsAreTheClosedForms) {
  EXPECT_DOUBLE_EQ(integral(CosineResponse{}), pi);
  EXPECT_NEAR(integral(CosinePowerResponse{3}), pi / 2, 1e-15);
  EXPECT_NEAR(integral(CosinePowerResponse{1, radians(60)}), 0.75 * pi, 1e-14);
  EXPECT_NEAR(integral(ResponseTable{{{0, pi / 2}, {0}, {1, 1}}}), 2 * pi, 1e-14);
}

}  // namespace
}  // namespace shelfbeam::test
