#include "shelfbeam/math/frame.hpp"
#include "shelfbeam/math/warp.hpp"

#include "support/testing.hpp"
#include "unit/scene/sample_store.hpp"

namespace shelfbeam::test {
namespace {

LabelType changed(const std::string& type, const std::string& key, const std::string& value) {
  const Store store = read(changed_store("/label_types/" + type + "/" + key, value));
  return *std::ranges::find(store.label_types, type, &LabelType::name);
}

TEST(LabelTypes, HaveAResponsivity) {
  const Store store = read(sample_store());
  EXPECT_TRUE(std::holds_alternative<CosineResponse>(store.label_types[0].responsivity));
  EXPECT_TRUE(std::holds_alternative<CosineResponse>(store.label_types[1].responsivity)) << "the default";
  const auto power = std::get<CosinePowerResponse>(store.label_types[2].responsivity);
  EXPECT_EQ(power.exponent, 2.5);
  EXPECT_EQ(power.cutoff, radians(60));
  const auto table = std::get<ResponseTable>(store.label_types[3].responsivity).response;
  EXPECT_EQ(table.values(), (std::vector<double>{2, 1.5, 0}));
  EXPECT_EQ(table.theta(), (std::vector<double>{0, radians(40), radians(75)}));
  const auto open = changed("deep", "responsivity/cutoff_deg", "").responsivity;
  EXPECT_EQ(std::get<CosinePowerResponse>(open).cutoff, pi / 2);
}

TEST(LabelTypes, HaveASize) {
  const Store store = read(sample_store());
  EXPECT_EQ(store.label_types[0].size, (std::array{0.0, 0.0}));
  EXPECT_EQ(store.label_types[1].size, (std::array{0.0, 0.0})) << "the default";
  EXPECT_EQ(store.label_types[2].size, (std::array{0.2, 0.1}));
}

// I R(0) / d^2, computed by hand. `down` has 2 W/sr at 45 degrees; the planes of `fan` at 0, 90, 200 and 360
// degrees have 1, 4, 7 and 1 W/sr on the axis.
TEST(LabelTypes, MayHaveARange) {
  const Store store = read(sample_store());
  EXPECT_NEAR(store.label_types[2].threshold, 2.0 / 25, 1e-15);
  const double mean = (90 * (1 + 4) / 2.0 + 110 * (4 + 7) / 2.0 + 160 * (7 + 1) / 2.0) / 360;
  EXPECT_NEAR(store.label_types[3].threshold, mean * 2 / 4, 1e-14);
  const auto spot = changed("deep", "threshold", R"({ "hears": "spot", "at_m": 6, "angle_deg": 10 })");
  EXPECT_NEAR(spot.threshold, 3 * 21 / (2 * pi) * std::pow(std::cos(radians(10)), 20) / 36, 1e-14);
  const auto ahead = changed("deep", "threshold", R"({ "hears": "spot", "at_m": 6 })");
  EXPECT_NEAR(ahead.threshold, 3 * 21 / (2 * pi) / 36, 1e-14) << "angle_deg is 0 by default";
}

// The angle is measured between the unit's axis and the line to the label, for any orientation: a tilted
// unit, seen in a plane across its tilt. Only rounding: 1e-12.
TEST(LabelTypes, ReceiveTheIntensityOfAFacingUnit) {
  const LabelType type = changed("deep", "threshold", R"({ "hears": "down", "at_m": 3, "angle_deg": 30 })");
  const Store store = read(sample_store());
  const Frame frame = Frame::of_device(normalized({0.3, 0.2, -1}), 0.4);
  const auto signal = [&](double angle_deg) {
    const Vec3 to_label = frame.to_world({0, std::sin(radians(angle_deg)), std::cos(radians(angle_deg))}) * 3;
    const Vec3 normal = normalized(-to_label);
    return intensity(store.transceiver_types[0].emission, frame.to_local(normalized(to_label))) *
           response(type.responsivity, -dot(normal, normalized(to_label))) / length_squared(to_label);
  };
  EXPECT_NEAR(type.threshold, signal(30), 1e-12);
  EXPECT_GT(std::abs(type.threshold - signal(31)), 1e-3) << "the control";
}

}  // namespace
}  // namespace shelfbeam::test
