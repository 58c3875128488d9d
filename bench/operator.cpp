// Measures the light operator: accuracy and time of previews beside a simulation of the same units, their
// stated errors, the unbiased refinement, and growth with the store.
//
//   build/release/bench_operator [STORE...] [--units N] [--samples N] [--coarse] [--seed S]
//   build/release/bench_operator --refine [STORE...] [--units N] [--seconds S]
//   build/release/bench_operator --growth [STORE...]
//   build/release/bench_operator --shops [--units N] [--samples N] [--seed S] [--coarse]
//
// Previews of N random units (100), a quarter each at the ceiling, tilted, beside walls and between shelves,
// are compared with one simulation that has them as candidates (10,000 samples per label, exact direct
// light). Errors are shares of the label's requirement; the variance of the simulation is subtracted from
// mean squares. Stated errors count as right where the simulation is within 1.96 errors of both, taken
// together; the first half of the units gives the factor by which stated errors would have to grow for 95 %,
// the second half the share with the errors as they are, with an interval by bootstrap over units.
//
// --refine compares refined columns of N units (200) after S seconds (3) with the simulation, by z-scores.
// The negative control counts refined values 3 % too high.
//
// --shops compares N units (200) in each of eight shops that are difficult for previews (preview_shops.hpp)
// with simulations, and prints how often stated errors hold for signals without doubt. Errors of one operator
// are common to many signals, so the units take turns with 20 operators of different seeds. The negative
// control counts previews 15 % too high.
//
// STORE: a folder of examples/ or a store file (default: supermarket; for --growth four examples).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/transport/operator/light_operator.hpp"
#include "shelfbeam/transport/operator/unit_refinement.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

#include "preview_errors.hpp"
#include "preview_shops.hpp"
#include "random_units.hpp"
#include "support.hpp"

namespace {

using namespace shelfbeam;
using namespace shelfbeam::bench;

struct Settings {
  std::vector<std::string> stores;
  std::size_t units = 0;  ///< 0: the default
  std::uint64_t samples = 10000, seed = 1;
  double seconds = 3;
  bool coarse = false, refine = false, growth = false, shops = false;

  OperatorEffort effort(const Scene& scene) const {
    return coarse ? coarse_operator : usual_effort(scene.labels.size());
  }
};

/// The simulation of random units, for comparison.
struct Truth {
  Truth(const Scene& scene, const std::vector<PlacedUnit>& units, std::uint64_t samples) {
    Scene changed = scene;
    changed.store_hash.clear();
    changed.transceivers.clear();
    for (const PlacedUnit& placed : units) changed.transceivers.push_back(placed.unit);
    SimulationOptions options;
    options.samples = samples;
    options.direct = DirectLight::exact;
    options.seed = 71;
    seconds = cpu_seconds([&] { matrix = simulate(changed, options).matrix; });
  }

  SignalMatrix matrix;
  double seconds = 0;
};

void print_times(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  const auto at = [&](double share) {
    return 1e3 * times[std::min(times.size() - 1,
                                static_cast<std::size_t>(share * static_cast<double>(times.size())))];
  };
  fmt::print("  a column: median {:.1f} ms, 90 % within {:.1f} ms, all within {:.1f} ms\n", at(0.5), at(0.9),
             1e3 * times.back());
}

std::unique_ptr<const LightOperator> make_operator(const World& world, const OperatorEffort& effort) {
  std::unique_ptr<const LightOperator> light;
  const double seconds =
      cpu_seconds([&] { light = std::make_unique<const LightOperator>(world, 1, effort); });
  fmt::print("  operator: {:.1f} s of CPU time, {:.0f} MB, {} cells\n", seconds,
             static_cast<double>(light->bytes()) / 1e6, light->nodes().cells().size());
  return light;
}

void compare(const Settings& settings, const std::string& store) {
  const Scene scene = open_scene(store);
  const World world(scene);
  const auto units = random_units(world, settings.units == 0 ? 100 : settings.units, settings.seed);
  fmt::print("{}: {} labels, {} units{}\n", store, scene.labels.size(), units.size(),
             settings.coarse ? ", coarse operator" : "");
  const auto light = make_operator(world, settings.effort(scene));
  std::vector<double> times;
  std::vector<Preview> previews;
  times.reserve(units.size());
  for (const PlacedUnit& placed : units)
    times.push_back(wall_seconds([&] { previews.push_back(light->column(placed.unit)); }));
  print_times(times);
  const Truth truth(scene, units, settings.samples);
  fmt::print("  the simulation of these units: {:.1f} s of CPU time, {:.2f} s per unit\n", truth.seconds,
             truth.seconds / static_cast<double>(units.size()));
  print_errors(preview_errors(scene, units, previews, truth.matrix));
}

void refine(const Settings& settings, const std::string& store) {
  const Scene scene = open_scene(store);
  const World world(scene);
  const auto units = random_units(world, settings.units == 0 ? 200 : settings.units, settings.seed);
  fmt::print("{}: {} labels, {} units refined for {:g} s each\n", store, scene.labels.size(), units.size(),
             settings.seconds);
  const auto light = make_operator(world, settings.effort(scene));
  RefinementErrors errors(scene);
  const Truth truth(scene, units, settings.samples);
  for (std::size_t j = 0; j < units.size(); ++j) {
    std::unique_ptr<UnitRefinement> refinement;
    double wall =
        wall_seconds([&] { refinement = std::make_unique<UnitRefinement>(*light, units[j].unit, 5); });
    std::size_t open = 1;
    while (open > 0 && (wall < settings.seconds || refinement->fewest_batches() < 2))
      wall += wall_seconds([&] { open = refinement->add(2, errors.target, {}); });
    errors.add(*refinement, truth.matrix, j);
  }
  errors.print();
}

void print_shops(const Settings& settings) {
  constexpr std::uint64_t operators = 20;
  ShopErrors errors;
  for (const PreviewShop& shop : preview_shops()) {
    const World world(shop.scene);
    const auto units = random_units(world, settings.units == 0 ? 200 : settings.units, settings.seed);
    std::vector<Preview> previews(units.size());
    for (std::uint64_t k = 0; k < operators; ++k) {
      const LightOperator light(world, settings.seed + k, settings.effort(shop.scene));
      for (std::size_t j = k; j < units.size(); j += operators) previews[j] = light.column(units[j].unit);
    }
    errors.add(shop, units, previews, Truth(shop.scene, units, settings.samples).matrix);
  }
  errors.print();
}

void print_growth(const std::vector<std::string>& stores) {
  fmt::print("{:<12} {:>7} {:>9} {:>8} {:>16} {:>8} {:>20}\n", "operator of", "labels", "area, m2", "cells",
             "CPU time, s", "MB", "column, ms: median");
  for (const std::string& store : stores) {
    const Scene scene = open_scene(store);
    const World world(scene);
    std::unique_ptr<const LightOperator> light;
    const double seconds = cpu_seconds(
        [&] { light = std::make_unique<const LightOperator>(world, 1, usual_effort(scene.labels.size())); });
    std::vector<double> times;
    for (const PlacedUnit& placed : random_units(world, 100, 1))
      times.push_back(wall_seconds([&] { static_cast<void>(light->column(placed.unit)); }));
    const auto middle = times.begin() + 50;
    std::nth_element(times.begin(), middle, times.end());
    const Vec3 size = scene.upper - scene.lower;
    fmt::print("{:<12} {:>7} {:>9.0f} {:>8} {:>16.1f} {:>8.0f} {:>20.1f}\n", store, scene.labels.size(),
               size.x * size.y, light->nodes().cells().size(), seconds,
               static_cast<double>(light->bytes()) / 1e6, 1e3 * *middle);
  }
}

Settings parse(int argc, char** argv) {
  Settings settings;
  Words words(argc, argv);
  while (words.any_left()) {
    const std::string word = words.next();
    const auto number = [&] { return std::strtoull(words.value().c_str(), nullptr, 10); };
    if (word == "--units")
      settings.units = number();
    else if (word == "--samples")
      settings.samples = number();
    else if (word == "--seed")
      settings.seed = number();
    else if (word == "--seconds")
      settings.seconds = std::strtod(words.value().c_str(), nullptr);
    else if (word == "--coarse")
      settings.coarse = true;
    else if (word == "--refine")
      settings.refine = true;
    else if (word == "--growth")
      settings.growth = true;
    else if (word == "--shops")
      settings.shops = true;
    else if (word.starts_with("--"))
      throw std::invalid_argument("unknown option " + word);
    else
      settings.stores.push_back(word);
  }
  if (settings.units > 0 && settings.units < 2 * unit_places.size())
    throw std::invalid_argument(fmt::format("--units must be at least {}", 2 * unit_places.size()));
  if (settings.stores.empty())
    settings.stores = settings.growth
                          ? std::vector<std::string>{"thesis", "grocery", "supermarket", "hypermarket"}
                          : std::vector<std::string>{"supermarket"};
  return settings;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Settings settings = parse(argc, argv);
    if (settings.shops) {
      print_shops(settings);
      return 0;
    }
    if (settings.growth) {
      print_growth(settings.stores);
      return 0;
    }
    for (const std::string& store : settings.stores)
      settings.refine ? refine(settings, store) : compare(settings, store);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
