// The program against an estimator that shares no line with it, in an empty room with three units; and that
// estimator with a mistake in it, which the same test must reject.

#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/stats/hypothesis.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

#include "physics/box_room_walk.hpp"

namespace shelfbeam {
namespace {

const Vec3 size{6, 4, 3};
const std::vector<Vec3> units{{1.5, 1, 2.9}, {4.5, 3.2, 2.9}, {5.2, 0.6, 2.5}};
struct Sensor {
  Vec3 position, normal;
};
const std::vector<Sensor> sensors{
    {{0.5, 2, 1}, {1, 0, 0}}, {{3, 2, 0.2}, {0, 0, 1}}, {{4, 3.9, 1.6}, {0, -1, 0}}};

Scene room(double albedo) {
  std::string labels, list;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const auto& [p, n] = sensors[i];
    labels +=
        fmt::format(R"({}{{"id": "S{}", "position": [{}, {}, {}], "normal": [{}, {}, {}], "type": "s"}})",
                    i == 0 ? "" : ",", i, p.x, p.y, p.z, n.x, n.y, n.z);
  }
  for (std::size_t j = 0; j < units.size(); ++j)
    list += fmt::format(R"({}{{"id": "T{}", "position": [{}, {}, {}], "type": "u"}})", j == 0 ? "" : ",", j,
                        units[j].x, units[j].y, units[j].z);
  return make_scene(parse_store(
      fmt::format(R"({{"room": {{"size": [{}, {}, {}], "floor": "w", "ceiling": "w", "walls": "w"}},
    "materials": {{"w": {{"type": "lambertian", "reflectance": {}}}}}, "label_types": {{"s": {{"threshold": 1}}}},
    "transceiver_types": {{"u": {{"emission": {{"type": "sin2theta", "peak": 1}}}}}},
    "transceivers": {{"list": [{}]}}, "labels": [{}]}})",
                  size.x, size.y, size.z, albedo, list, labels),
      "room", "."));
}

// All nine entries at once at 0.1 %; 200,000 samples each, a relative standard error of 0.5 to 1 %.
bool agrees(const SignalMatrix& matrix, double albedo, const test::Mistakes& mistakes) {
  const test::BoxRoomWalk walk(size, albedo, units, mistakes);
  std::vector<double> values, references, errors;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const auto moments = walk.estimate(sensors[i].position, sensors[i].normal, 200000, 40 + i);
    for (std::size_t j = 0; j < units.size(); ++j) {
      const std::size_t entry = matrix.at(i, j);
      values.push_back(matrix.mean[entry]);
      references.push_back(moments[j].mean());
      errors.push_back(std::hypot(matrix.standard_error[entry], moments[j].standard_error()));
    }
  }
  return z_test(values, references, errors, 0.001, batch_count - 1).pass;
}

TEST(BoxRoom, AgreesWithAnEstimatorWrittenAnewAndRejectsItsMistakes) {
  constexpr double albedo = 0.7;
  const SignalMatrix matrix = simulate(room(albedo), "", {200000, DirectLight::sampled, 5}).matrix;
  EXPECT_TRUE(agrees(matrix, albedo, {}));
  EXPECT_FALSE(agrees(matrix, 1.02 * albedo, {}));
  EXPECT_FALSE(agrees(matrix, albedo, {.no_cosine_at_surfaces = true}));
  EXPECT_FALSE(agrees(matrix, albedo, {.no_cosine_at_the_label = true}));
  EXPECT_FALSE(agrees(matrix, albedo, {.extra_units = 1}));
}

}  // namespace
}  // namespace shelfbeam
