#include "shelfbeam/report/chart/palette.hpp"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace shelfbeam {
namespace {

// Relative luminance of "#rrggbb" (IEC 61966-2-1).
double luminance(const std::string& colour) {
  const auto linear = [&](std::size_t at) {
    const double c = std::stoi(colour.substr(at, 2), nullptr, 16) / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(1) + 0.7152 * linear(3) + 0.0722 * linear(5);
}

bool grows_in_grey(const std::function<std::string(double)>& colours) {
  for (int k = 1; k <= 20; ++k)
    if (luminance(colours(k / 20.0)) <= luminance(colours((k - 1) / 20.0))) return false;
  return true;
}

TEST(Palette, SignalColoursKeepTheirOrderInGrey) {
  EXPECT_TRUE(grows_in_grey(viridis));
  EXPECT_EQ(viridis(0), "#440154");
  EXPECT_EQ(viridis(1), "#fde725");
  // Negative control: a scale from blue to red by way of green does not.
  EXPECT_FALSE(grows_in_grey([](double t) { return t < 0.4 ? "#0000ff" : t < 0.7 ? "#00ff00" : "#ff0000"; }));
}

TEST(Palette, MarginClassesAgreeWithTheRequirement) {
  EXPECT_EQ(margin_class(-20, false), 0U);
  EXPECT_EQ(margin_class(-2, false), 1U);
  EXPECT_EQ(margin_class(0, true), 2U);
  EXPECT_EQ(margin_class(-1e-9, true), 2U);   // met within the tolerance
  EXPECT_EQ(margin_class(1e-12, false), 1U);  // never displayed as met
  EXPECT_EQ(margin_class(1, true), 3U);
  EXPECT_EQ(margin_class(9.99, true), 5U);
  EXPECT_EQ(margin_class(30, true), 6U);
  EXPECT_EQ(margin_class(-INFINITY, false), 0U);
}

TEST(Palette, SignalScaleCoversTheLargestValues) {
  const SignalScale scale({0, 0.012, 0.012, 0.3}, 12);
  EXPECT_EQ(scale.edges.front(), 0.01);
  EXPECT_EQ(scale.edges.back(), 0.5);
  EXPECT_EQ(scale.class_of(0.012), 0U);
  EXPECT_EQ(scale.class_of(0.3), scale.classes() - 1);
  const SignalScale wide({1e-9, 1e-9, 1}, 6);
  EXPECT_EQ(wide.classes(), 6U);
  EXPECT_EQ(wide.class_of(1e-9), 0U);
  EXPECT_EQ(wide.class_of(1), 5U);
  std::vector<double> mostly_strong(99, 1.5);
  mostly_strong.push_back(1e-6);
  EXPECT_EQ(SignalScale(mostly_strong, 12).edges, (std::vector<double>{1, 2}));
  EXPECT_EQ(SignalScale({0, 0}, 6).classes(), 1U);
}

}  // namespace
}  // namespace shelfbeam
