// The reuse estimator against the paper's: efficiency, agreement, speed of their rays, threads, growth. All
// in one process, a batch of each in turn, on one thread unless said otherwise.
//
//   build/release/bench_estimators [STORE...] [--quick] [--walks N] [--batches N] [--labels N]
//
// STORE: a folder of examples/ or a store file (default: thesis grocery).

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <tbb/global_control.h>

#include "comparison.hpp"
#include "support.hpp"

namespace {

using namespace shelfbeam;
using namespace shelfbeam::bench;

constexpr std::uint32_t least_contributions = 30;

struct Settings {
  std::vector<std::string> stores;
  std::uint64_t walks = 64000;  ///< a label, of the uniform estimator
  std::uint64_t batches = 64;   ///< of every estimator
  std::uint64_t labels = 1000;  ///< at most, of larger stores some clusters
};

void print_efficiency(const Scene& scene, const Selection& selection, const Entrant& reuse,
                      const Entrant& other) {
  for (const double above : {0.3, 0.02}) {
    const EfficiencyRatio found =
        efficiency_ratio(scene, selection, reuse, other, above, least_contributions);
    fmt::print("  {:<24} above {:<5g} {:>8.0f} {:>14.0f} {:>9} {:>9}\n", other.title, above, found.ratio,
               found.without_cache, found.entries, found.left_out);
  }
}

void print_agreement(const Entrant& reuse, const Entrant& other) {
  const BatchSums &a = reuse.sums, &b = other.sums;
  const auto print = [&](const char* what, const Agreement& found) {
    fmt::print("  {:<24} {:<11} {:>8.3f} {:>8.2f} {:>9.2f} {:>9}\n", other.title, what, found.rms,
               found.largest, 100 * found.beyond_3, found.values);
  };
  print("entries", agreement(a, b, least_contributions));
  print("labels", agreement(a.by_row, b.by_row));
  print("candidates", agreement(a.by_column, b.by_column));
  const double ratio = a.all.mean / b.all.mean;
  const double error = ratio * std::sqrt(a.all.variance() / (a.all.mean * a.all.mean) +
                                         b.all.variance() / (b.all.mean * b.all.mean));
  fmt::print("  {:<24} sum of all entries over its {:.5f} +- {:.5f}\n", "", ratio, error);
}

void compare(const Settings& settings, const Scene& scene) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const World world(scene);
  std::unique_ptr<const ReuseEstimator> estimator;
  const double cache_seconds =
      cpu_seconds([&] { estimator = std::make_unique<const ReuseEstimator>(world, 1); });
  const Selection selection(*estimator, settings.labels);
  const auto walks = static_cast<std::uint32_t>((settings.walks + settings.batches - 1) / settings.batches);
  UniformEntrant sampled(world, selection, true, walks), exact(world, selection, false, walks);
  ReuseEntrant reuse(world, selection, *estimator, cache_seconds);
  for (std::uint64_t round = 0; round < settings.batches; ++round)
    for (Entrant* entrant :
         {static_cast<Entrant*>(&sampled), static_cast<Entrant*>(&exact), static_cast<Entrant*>(&reuse)})
      entrant->run();

  fmt::print("{}: {} triangles, {} of {} labels, {} candidates; {} batches of {} walks a label; reuse: {}\n",
             scene.name, scene.mesh.triangles.size(), selection.labels.size(), scene.labels.size(),
             scene.transceivers.size(), settings.batches, walks, estimator->name());
  fmt::print("\n  CPU time, s              {:>11} {:>8} {:>8} {:>9}\n", "batches", "direct", "cache",
             "Mrays/s");
  for (const Entrant* entrant : {static_cast<const Entrant*>(&sampled), static_cast<const Entrant*>(&exact),
                                 static_cast<const Entrant*>(&reuse)})
    fmt::print("  {:<24} {:>11.2f} {:>8.3f} {:>8.3f} {:>9.3f}\n", entrant->title, entrant->seconds,
               entrant->known_seconds, entrant->cache_seconds,
               static_cast<double>(entrant->rays) / entrant->seconds / 1e6);
  fmt::print("\n  efficiency of reuse over             {:>8} {:>14} {:>9} {:>9}\n", "ratio", "without cache",
             "entries", "left out");
  print_efficiency(scene, selection, reuse, sampled);
  print_efficiency(scene, selection, reuse, exact);
  fmt::print("\n  agreement of reuse with              {:>8} {:>8} {:>9} {:>9}\n", "rms z", "largest",
             "% beyond 3", "values");
  print_agreement(reuse, sampled);
  print_agreement(reuse, exact);
  fmt::print("\n");
}

Settings parse(int argc, char** argv) {
  Settings settings;
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    const auto number = [&] {
      if (k + 1 == argc) throw std::invalid_argument(word + " needs a number");
      return std::strtoull(argv[++k], nullptr, 10);
    };
    if (word == "--quick") {
      settings.walks = 3200;
      settings.batches = 16;
    } else if (word == "--walks") {
      settings.walks = number();
    } else if (word == "--batches") {
      settings.batches = number();
    } else if (word == "--labels") {
      settings.labels = number();
    } else if (word.starts_with("--")) {
      throw std::invalid_argument("unknown option " + word);
    } else {
      settings.stores.push_back(word);
    }
  }
  if (settings.batches < 2) throw std::invalid_argument("--batches must be at least 2");
  if (settings.stores.empty()) settings.stores = {"thesis", "grocery"};
  return settings;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Settings settings = parse(argc, argv);
    for (const std::string& store : settings.stores) compare(settings, open_scene(store));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
