// Compares an empty room of 10 x 8 x 4 m with the results of two other programs (test/data/room_s1).

#include <cmath>
#include <filesystem>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

#include "physics/comparison.hpp"
#include "support/hypothesis.hpp"

namespace shelfbeam::physics::room_s1 {
namespace {

using test::Way;

const std::filesystem::path folder = std::filesystem::path(SHELFBEAM_SOURCE_DIR) / "test/data/room_s1";

SignalMatrix simulate_room(const Way& way, std::uint64_t samples, DirectLight direct,
                           double albedo_factor = 1) {
  Store store = read_store(folder / "store.json");
  std::get<Lambertian>(store.materials[0].material).reflectance *= albedo_factor;
  return way.simulate(make_scene(store), samples, 7, {.direct = direct});
}

test::Comparison compare(const SignalMatrix& matrix, const JsonCursor& reference) {
  const std::vector<double> total = reference["E_total"].numbers(), error = reference["stderr"].numbers();
  test::Comparison result;
  for (std::size_t i = 0; i < matrix.rows(); ++i)
    result.add(matrix.mean[i], total[i], std::hypot(matrix.standard_error[i], error[i]));
  return result;
}

// Tests all twelve totals together at 1 %, with combined errors below `precision`. The control is an albedo 2
// % off.
void expect_agreement(const Way& way, std::uint64_t samples, DirectLight direct, double precision) {
  const JsonCursor reference = JsonCursor::parse_file(folder / "reference.json");
  const SignalMatrix matrix = simulate_room(way, samples, direct);
  for (const JsonCursor& of_program : {reference, reference["radiance"]}) {
    const test::Comparison found = compare(matrix, of_program);
    EXPECT_TRUE(found.agrees(0.01)) << way.name;
    EXPECT_LT(found.precision(), precision) << way.name;
  }
  EXPECT_FALSE(compare(simulate_room(way, samples, direct, 1.02), reference).agrees(0.01)) << way.name;
}

TEST(RoomS1, DirectPartIsExact) {
  const auto direct = JsonCursor::parse_file(folder / "reference.json")["E_direct"].numbers();
  const SignalMatrix matrix = simulate_room(test::mis, 64, DirectLight::exact);
  for (std::size_t i = 0; i < matrix.rows(); ++i)
    EXPECT_NEAR(matrix.direct[i], direct[i], 1e-5 * direct[i]) << matrix.labels[i].id;
}

TEST(RoomS1Slow, TotalsAgreeWithBothSimulators) {
  expect_agreement(test::mis, 150000, DirectLight::sampled, 0.005);
  expect_agreement(test::mis, 50000, DirectLight::exact, 0.005);
  expect_agreement(test::particle, 50000, DirectLight::sampled, 0.01);
  expect_agreement(test::path_reuse, 16 * test::reuse_samples, DirectLight::exact, 0.01);
  // Walks never hit points.
  EXPECT_EQ(simulate_room(test::nee, 640, DirectLight::sampled).mean,
            simulate_room(test::mis, 640, DirectLight::sampled).mean);
}

}  // namespace
}  // namespace shelfbeam::physics::room_s1
