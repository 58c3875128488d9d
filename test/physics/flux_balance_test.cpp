// In a closed room of uniform albedo rho, all flux Phi that enters is finally absorbed, and all reflected
// light is incident again. All walls together receive rho Phi / (1 - rho) over all bounces.

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/stats/moments.hpp"
#include "shelfbeam/transport/run/sample_batches.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

#include "physics/bare_scene.hpp"
#include "physics/comparison.hpp"
#include "support/hypothesis.hpp"

namespace shelfbeam::physics::flux_balance {
namespace {

constexpr double rho = 0.7, phi = 4 * pi / 3;  // W, for a sin 2 theta unit of 1 W/sr

struct Incident {
  Moments reflected;  // of batches
  double direct = 0;
};

// A room of 5 x 4 x 3 m with a label in the middle of each of `cells` x `cells` cells on every wall.
Incident incident_flux(const SimulationOptions& options, std::uint32_t batches, int cells) {
  const Vec3 size{5, 4, 3};
  test::BareScene room;
  room.box(room.material(Lambertian{rho}), {0, 0, 0}, size);
  room.unit({2.2, 1.7, 2.1}, {0, 0, -1}, SinTwoTheta{1});
  std::vector<double> areas;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool far : {false, true})
      for (int cell = 0; cell < cells * cells; ++cell) {
        const int a = (axis + 1) % 3, b = (axis + 2) % 3;
        std::array<double, 3> p{}, n{};
        const auto at = [](int d) { return static_cast<std::size_t>(d); };
        p[at(axis)] = far ? size[axis] - 1e-4 : 1e-4;
        const int row = cell / cells;
        p[at(a)] = (row + 0.5) * size[a] / cells;
        p[at(b)] = (cell % cells + 0.5) * size[b] / cells;
        n[at(axis)] = far ? -1 : 1;
        room.label({p[0], p[1], p[2]}, {n[0], n[1], n[2]});
        areas.push_back(size[a] * size[b] / (cells * cells));
      }
  std::vector<double> flux(batches);
  std::vector<std::uint32_t> next(areas.size());
  const auto take = [&](const BatchRow& row) { flux[next[row.label]++] += areas[row.label] * row.values[0]; };
  const BatchRun run = sample_batches(room.scene, options, batches, take, {1});
  Incident found;
  for (const double of_batch : flux) found.reflected.add(of_batch);
  for (std::size_t i = 0; i < areas.size(); ++i) found.direct += areas[i] * static_cast<double>(run.known[i]);
  return found;
}

// z-test at 0.1 %. The statistical errors are 0.05 to 0.15 %; the midpoint rule errs by 0.07 % of the direct
// flux with 24 cells per side, and by 0.1 % of the rest with 10. The control is an albedo off by `wrong`.
void expect_balance(const SimulationOptions& options, std::uint32_t batches, int cells, double wrong,
                    const char* what) {
  const auto all = [](double albedo) { return phi * albedo / (1 - albedo); };
  const Incident found = incident_flux(options, batches, cells);
  EXPECT_NEAR(found.direct / phi, 1, cells == 24 ? 7e-4 : 0.02) << what;
  test::Comparison reflected;
  reflected.add(found.reflected.mean(), all(rho),
                std::hypot(found.reflected.standard_error(), 1e-3 * all(rho)));
  test::expect_agreement(reflected, 2e-3, all(wrong * rho) / all(rho), what);
}

TEST(FluxBalanceSlow, EverythingThatEntersIsAbsorbed) {
  SimulationOptions options{EstimatorKind::uniform};
  options.samples = 640;
  options.direct = DirectLight::exact;
  options.seed = 3;
  expect_balance(options, batch_count, 24, 1.02, "walks");
  options.estimator = EstimatorKind::reuse;
  expect_balance(options, 2 * batch_count, 10, 1.01, "path reuse");
}

}  // namespace
}  // namespace shelfbeam::physics::flux_balance
