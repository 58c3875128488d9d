#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/report/viewer/page_signals.hpp"

#include "unit/report/corner_shop.hpp"
#include "unit/report/page_reader.hpp"

namespace shelfbeam {
namespace {

test::PageReader page_of(const ReportInput& input) {
  return test::PageReader(pack_store(ReportData(input), SignalScale({0.1, 1})));
}

TEST(PageRoom, HasTheSurfacesOfTheRoom) {
  const test::CornerShop shop;
  const auto page = page_of(shop.input);
  const auto vertex = page.get<float>("room_vertex");
  const auto triangle = page.get<std::uint32_t>("room_triangle");
  const auto surface = page.get<std::uint8_t>("room_surface");
  ASSERT_EQ(triangle.size(), 3 * surface.size());
  std::map<int, double> area, upward;
  double outward = 0;
  const auto corner = [&](std::size_t k) {
    const std::size_t at = std::size_t{3} * triangle[k];
    return Vec3{static_cast<double>(vertex[at]), static_cast<double>(vertex[at + 1]),
                static_cast<double>(vertex[at + 2])};
  };
  for (std::size_t t = 0; t < surface.size(); ++t) {
    const Vec3 a = corner(3 * t), b = corner(3 * t + 1), c = corner(3 * t + 2);
    const Vec3 normal = cross(b - a, c - a) / 2;
    area[surface[t]] += length(normal);
    upward[surface[t]] += normal.z;
    if (surface[t] == 1) outward += dot(normal, a) / 3;
  }
  const double floor = 12 * 10 - 4 * 4 / 2.0 - 1;
  const double walls = 0.2 * 2.9 + 0.2 * 5;  // in plan, with the corner of both once
  EXPECT_NEAR(area[0], floor - walls + 0.2 * 0.9, 0.05) << "also in the door";
  EXPECT_NEAR(upward[0], area[0], 1e-3);
  EXPECT_NEAR(area[3], 0.8 * 1.1, 1e-4) << "the pane";
  EXPECT_GT(area[2], 2 * 2.0 * 3.2 / 2) << "inner walls";
  // The shell faces away from the room: from the origin, walls and ceilings enclose a positive volume, which
  // is that of the room because the floor is at the height of the origin.
  EXPECT_NEAR(outward, 3.2 * (floor - 16 - 0.2 * 2.9) + 2.6 * 16, 2.5);
  std::vector<std::string> names;
  for (const auto& fixture : page.about["fixtures"]) names.push_back(fixture["id"]);
  EXPECT_EQ(names, (std::vector<std::string>{"row", "counter", "column", "screen", "W1", "W2", "bakery"}));
}

// The page of a plain box keeps its bytes.
TEST(PageRoom, IsOmittedForABox) {
  const test::Supermarket s;
  EXPECT_ANY_THROW(page_of(s.input).get<float>("room_vertex"));
}

}  // namespace
}  // namespace shelfbeam
