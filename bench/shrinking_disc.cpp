// Measures the light that no strategy finds for point transceivers. A room with a mirror, a cabinet of panes
// and a block of glass is lit by points, and by discs of shrinking radius, whose light is complete.
//
//   build/release/bench_shrinking_disc [SAMPLES]      (default: 400000)

#include <cmath>
#include <cstdlib>
#include <exception>
#include <initializer_list>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/report/messages/light.hpp"
#include "shelfbeam/report/text/words.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/transport/run/simulate.hpp"
#include "shelfbeam/transport/world/coverage.hpp"

namespace {

using namespace shelfbeam;

constexpr const char* store_text = R"({
  "room": { "size": [6, 5, 3], "floor": "tiles", "ceiling": "paint", "walls": "paint" },
  "materials": {
    "paint": { "type": "lambertian", "reflectance": 0.7 },
    "tiles": { "type": "plastic", "ior": 1.5, "reflectance": 0.4 },
    "carton": { "type": "lambertian", "reflectance": 0.5 },
    "mirror": { "type": "conductor", "eta": 0.2, "k": 6 },
    "door": { "type": "thin_dielectric", "ior": 1.5, "thickness": 0.006, "absorption_per_m": 2 },
    "glass": { "type": "dielectric", "ior": 1.5 }
  },
  "label_types": { "standard": { "threshold": 0.02 } },
  "transceiver_types": { "unit": { "emission": { "type": "sin2theta", "peak": 1 } } },
  "fixtures": [
    { "type": "gondola", "id": "A1", "at": [1, 1.1], "length": 3, "depth": 0.8, "height": 1.6, "material": "carton",
      "shelves": [0.5, 1.1], "labels": { "type": "standard", "spacing": 0.6 } },
    { "type": "gondola", "id": "A2", "at": [1, 3.3], "length": 3, "depth": 0.8, "height": 1.6, "material": "carton",
      "shelves": [0.5, 1.1], "labels": { "type": "standard", "spacing": 0.6 } },
    { "type": "box", "id": "mirror", "min": [5.96, 1.2, 0.6], "max": [5.99, 3.8, 2.2], "material": "mirror" },
    { "type": "box", "id": "cabinet", "min": [4.2, 4.2, 0], "max": [5.4, 4.9, 1.8], "material": "door" },
    { "type": "box", "id": "block", "min": [2.2, 2.45, 1.0], "max": [2.9, 2.95, 1.9], "material": "glass" }
  ],
  "transceivers": { "list": [
    { "id": "T1", "position": [1.2, 0.8, 2.9], "type": "unit" },
    { "id": "T2", "position": [4.4, 1.4, 2.9], "type": "unit" },
    { "id": "T3", "position": [2.5, 2.6, 2.9], "type": "unit" },
    { "id": "T4", "position": [4.9, 4.2, 2.9], "type": "unit" } ] }
})";

SignalMatrix simulate_with(Scene scene, double radius, std::uint64_t samples) {
  scene.transceiver_types[0].radius = radius;
  SimulationOptions options{EstimatorKind::uniform};
  options.samples = samples;
  options.direct = DirectLight::exact;
  return simulate(scene, options).matrix;
}

void compare(const Scene& scene, std::initializer_list<double> radii, std::uint64_t samples) {
  for (const std::string& light : light_texts(english(), uncovered_light(scene), scene))
    fmt::print("not covered: {}\n", light);
  const SignalMatrix points = simulate_with(scene, 0, samples);
  fmt::print(
      "\n| radius, m | sum of all signals, discs over points | standard error | entries changed by "
      "more than 5 % |\n| --- | --- | --- | --- |\n");
  for (const double radius : radii) {
    const SignalMatrix discs = simulate_with(scene, radius, samples);
    double disc_sum = 0, point_sum = 0, variance = 0;
    int changed = 0;
    for (std::size_t i = 0; i < discs.rows(); ++i) {
      double row_error = 0;  // entries of a row share walks, so their errors may add up
      for (std::size_t j = 0; j < discs.columns(); ++j) {
        const std::size_t e = discs.at(i, j);
        disc_sum += discs.mean[e];
        point_sum += points.mean[e];
        const double error = std::hypot(discs.standard_error[e], points.standard_error[e]);
        row_error += error;
        if (std::abs(discs.mean[e] / points.mean[e] - 1) - 2 * error / points.mean[e] > 0.05) ++changed;
      }
      variance += row_error * row_error;
    }
    fmt::print("| {:g} | {:.4f} | {:.4f} | {} of {} |\n", radius, disc_sum / point_sum,
               std::sqrt(variance) / point_sum, changed, discs.mean.size());
  }
}

void compare_all(std::uint64_t samples) {
  Store store = parse_store(store_text, "store", ".");
  compare(make_scene(store), {0.4, 0.2, 0.1, 0.05}, samples);
  fmt::print("\nWithout the block of glass\n");
  store.fixtures.pop_back();
  compare(make_scene(store), {0.4, 0.2}, samples);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    compare_all(argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 400000);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
