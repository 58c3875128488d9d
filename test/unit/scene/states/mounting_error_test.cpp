#include "shelfbeam/scene/states/mounting_error.hpp"

#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/scene/states/draws.hpp"
#include "shelfbeam/stats/moments.hpp"

#include "support/testing.hpp"
#include "unit/scene/stores.hpp"

namespace shelfbeam::test {
namespace {

constexpr double sigma = 0.05;  // m
constexpr int draws = 20'000;

// A room with an oblique wall, a shaft, a lower ceiling, an inner wall and a column.
Scene hall() {
  Json store = store_of_room(l_shaped_room("tile", ""));
  store["room"].update(R"({"height": 3,
    "zones": [{"id": "low", "polygon": [[2, 9], [6, 9], [6, 12], [2, 12]], "height": 2.5},
              {"id": "next", "polygon": [[6, 9], [7, 9], [7, 12], [6, 12]], "height": 2.6}],
    "inner_walls": [{"id": "W", "from": [4, 0], "to": [4, 6], "openings": [{"at": 1, "width": 2, "top": 2.1}]}]})"_json);
  store["fixtures"] =
      R"([{"type": "box", "id": "C", "at": [15, 10, 0], "size": [0.4, 0.4, 3], "rotation_deg": 30,
                           "material": "white"}])"_json;
  return scene_of(store);
}

Vec2 deviation(std::uint64_t k) {
  const Draws normal(1, k, "deviation");
  return {sigma * normal.normal(0), sigma * normal.normal(1)};
}

// Along two directions: means and mean squares of what `move` makes of normal deviations.
struct Spread {
  Spread(const Vec2& across, const std::function<Vec2(const Vec2&)>& move) {
    for (int k = 0; k < draws; ++k) {
      const Vec2 by = move(deviation(static_cast<std::uint64_t>(k)));
      const double x = by[0] * across[0] + by[1] * across[1], y = by[1] * across[0] - by[0] * across[1];
      u.add(x);
      v.add(y);
      squared_u.add(x * x);
      squared_v.add(y * y);
    }
  }
  Moments u, v, squared_u, squared_v;
};

// A z-test with an error probability of 6e-7.
bool agrees(const Moments& found, double expected) {
  return std::abs(found.mean() - expected) < 5 * found.standard_error();
}

// The mean square of a normal deviation that is reflected at -limit and limit, by quadrature.
double folded_square(double limit) {
  constexpr int steps = 200'000;
  constexpr double farthest = 10 * sigma, step = 2 * farthest / steps;
  double sum = 0;
  for (int k = 0; k < steps; ++k) {
    const double x = -farthest + (k + 0.5) * step;
    const double turn = std::fmod(std::abs(x) + limit, 4 * limit);
    const double folded = turn <= 2 * limit ? turn - limit : 3 * limit - turn;
    sum += folded * folded * std::exp(-x * x / (2 * sigma * sigma)) * step;
  }
  return sum / (sigma * std::sqrt(2 * pi));
}

struct Place {
  std::string name;
  Vec3 at;
  Vec2 across;  // unit length
  double to_surface, on_surface;
};

// Each of some 40 tests fails with a probability of 6e-7.
TEST(MountingError, KeepsTheMeanAndHasTheSpreadOfReflections) {
  const Scene scene = hall();
  const MountingError error(scene);
  const double turn = std::atan2(1, 8);  // of the oblique wall
  for (const Place& place : std::vector<Place>{
           {"open space", {10, 12, 2.9}, {1, 0}, 1, 1},
           {"wall", {0.03, 7, 2.9}, {1, 0}, 0.03, 1},
           {"on a wall", {0.0001, 7, 2.9}, {1, 0}, 0.0001, 1},
           {"corner of the room", {0.03, 0.04, 2.9}, {1, 0}, 0.03, 0.04},
           {"oblique wall",
            {16 - 0.02 * std::sin(turn), 5.5 + 0.02 * std::cos(turn), 2.9},
            {-std::sin(turn), std::cos(turn)},
            0.02,
            1},
           {"shaft", {7.97, 8.5, 2.9}, {1, 0}, 0.03, 1},
           {"lower ceiling", {1.96, 10, 2.9}, {1, 0}, 0.04, 1},
           {"below it", {2.04, 10, 2.4}, {1, 0}, 1, 1},
           {"from low to lower", {6.04, 10, 2.55}, {1, 0}, 0.04, 1},
           {"inner wall", {4.08, 5, 2.9}, {1, 0}, 0.03, 1},
           {"in a doorway", {4, 1.02, 1}, {0, 1}, 0.02, 1},
           {"between two walls", {4.07, 0.5, 2.9}, {1, 0}, 0.02, 0.5},
           {"column",
            {15.0 - 0.02 * std::cos(pi / 6) - 0.2 * 0.5, 10 - 0.02 * 0.5 + 0.2 * std::cos(pi / 6), 2},
            {std::cos(pi / 6), 0.5},
            0.02,
            1}}) {
    const Spread found(place.across, [&](const Vec2& by) {
      const Vec3 moved = error.moved(place.at, by);
      EXPECT_TRUE(scene.room->beyond(moved, 0).empty()) << place.name;
      EXPECT_EQ(moved.z, place.at.z);
      return Vec2{moved.x - place.at.x, moved.y - place.at.y};
    });
    EXPECT_TRUE(agrees(found.u, 0)) << place.name << ": " << found.u.mean();
    EXPECT_TRUE(agrees(found.v, 0)) << place.name << ": " << found.v.mean();
    // Positions are rounded to 1e-6 m.
    const double across = place.to_surface < 1e-3 ? found.squared_u.mean() : folded_square(place.to_surface);
    EXPECT_LE(across, place.to_surface * place.to_surface);
    EXPECT_TRUE(agrees(found.squared_u, across)) << place.name << ": " << std::sqrt(found.squared_u.mean());
    EXPECT_TRUE(agrees(found.squared_v, folded_square(place.on_surface)))
        << place.name << ": " << std::sqrt(found.squared_v.mean());
  }
}

// The tests would find the rule of draws that are repeated until the unit is inside: 3 cm from a wall, its
// mean moves by 2.3 cm.
TEST(MountingError, OneSidedDrawsWouldFail) {
  const Spread wrong({1, 0}, [](const Vec2& by) {
    Vec2 moved = by;
    for (std::uint64_t k = 1; moved[0] < -0.03; ++k)
      moved = deviation(1'000'000 + k + static_cast<std::uint64_t>(1e6 * std::abs(by[0])));
    return moved;
  });
  EXPECT_FALSE(agrees(wrong.u, 0));
  EXPECT_NEAR(wrong.u.mean(), 0.023, 0.002);
}

// Around a corner of a column and in a narrow niche, deviations are shortened.
TEST(MountingError, IsSymmetricAtCorners) {
  const Scene scene = hall();
  const MountingError error(scene);
  for (const Vec3& at :
       {Vec3{14.98, 9.99, 2}, Vec3{7.99, 7.98, 2.9}, Vec3{11.97, 0.02, 2.9}, Vec3{4.06, 6.01, 2}})
    for (int k = 0; k < 2000; ++k) {
      const Vec2 by = deviation(static_cast<std::uint64_t>(k));
      const Vec3 one = error.moved(at, by), other = error.moved(at, {-by[0], -by[1]});
      EXPECT_NEAR(one.x + other.x, 2 * at.x, 2e-6);
      EXPECT_NEAR(one.y + other.y, 2 * at.y, 2e-6);
      EXPECT_TRUE(scene.room->beyond(one, 0).empty());
    }
}

TEST(MountingError, LeavesOpenSpaceAlone) {
  const Scene scene = hall();
  const MountingError error(scene);
  EXPECT_EQ(error.moved({10, 12, 2.9}, {0.1234567, -0.05}), (Vec3{10.123457, 11.95, 2.9}));
  EXPECT_EQ(error.moved({15.1, 10.2, 1}, {0.05, 0.05}), (Vec3{15.1, 10.2, 1})) << "inside the column";
}

}  // namespace
}  // namespace shelfbeam::test
