// Compares the reuse estimator with the paper's: efficiency, agreement, ray speed, threads, and growth with
// the store. All estimators run in one process, a batch of each in turn, on one thread unless stated
// otherwise.
//
//   build/release/bench_estimators [STORE...] [--quick] [--walks N] [--batches N] [--labels N]
//   build/release/bench_estimators --growth [STORE...]
//   build/release/bench_estimators --caps [STORE...] [--batches N] [--labels N]
//   build/release/bench_estimators --before PROGRAM [STORE...] [--seeds S] [--samples N]
//   build/release/bench_estimators --against-paper [STORE...] [--seeds S] [--samples N] [--reference N]
//
// --quick takes at most a minute; the variances of the uniform estimator are then rough. Only entries with 30
// contributions in both estimators count; a contribution of the reuse estimator is a batch.
//
// --before and --against-paper run programs on one thread with S seeds in turn (8) and N samples per label
// (4192), and measure the CPU time of the whole process. --before compares the default estimator of this
// build with the one of an earlier program: by the variances that the files state, and by the variances of
// the means over the seeds, also by unit if there are up to eight. --against-paper compares it with the
// paper's estimator of this build and with particles from the units, by mean square errors against a long run
// of the former with exact direct light (--reference: its samples per label, 4,000,000).
//
// --caps compares distances from a unit at which its bright spots are capped (SpotRule), by the efficiency
// relative to the default, which chooses the distances by the number of units nearby.
//
// STORE: a folder of examples/ or a store file (default: thesis grocery; for --growth the large ones, too).

#include <algorithm>
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
#include "over_seeds.hpp"
#include "ray_kinds.hpp"
#include "scaling.hpp"
#include "support.hpp"

namespace {

using namespace shelfbeam;
using namespace shelfbeam::bench;

constexpr std::uint32_t min_contributions = 30;

struct Settings {
  std::vector<std::string> stores;
  std::uint64_t walks = 64000;  ///< per label, of the uniform estimator
  std::uint64_t batches = 64;   ///< of every estimator
  std::uint64_t labels = 1000;  ///< about the number of labels in the clusters chosen from larger stores
  bool threads = true;
  bool growth = false;
  bool caps = false;
  OverSeeds over_seeds;
  std::string earlier_program;  ///< empty: none
  bool against_paper = false;
};

void print_efficiency(const Scene& scene, const Selection& selection, const Entrant& reuse,
                      const Entrant& other) {
  for (const double above : {0.3, 0.02}) {
    const EfficiencyRatio found = efficiency_ratio(scene, selection, reuse, other, above, min_contributions);
    fmt::print("  {:<24} above {:<5g} {:>8.0f} {:>14.0f} {:>9} {:>9}\n", other.title, above, found.ratio,
               found.without_cache, found.entries, found.omitted);
  }
}

void print_agreement(const Entrant& reuse, const Entrant& other) {
  const BatchSums &a = reuse.sums, &b = other.sums;
  const auto print = [&](const char* what, const Agreement& found) {
    fmt::print("  {:<24} {:<10} {:>8.3f} {:>8.3f} {:>8.2f} {:>8.2f} {:>9}\n", other.title, what, found.pooled,
               found.rms, found.largest, 100 * found.beyond_3, found.values);
  };
  print("entries", agreement(a, b, min_contributions));
  print("labels", agreement(a.by_row, b.by_row));
  print("candidates", agreement(a.by_column, b.by_column));
  const double ratio = a.all.mean / b.all.mean;
  const double error = ratio * std::sqrt(a.all.variance() / (a.all.mean * a.all.mean) +
                                         b.all.variance() / (b.all.mean * b.all.mean));
  fmt::print("  {:<24} sum of all entries over its {:.5f} +- {:.5f}\n", "", ratio, error);
}

void print_rays(const Entrant& entrant, double bare_seconds) {
  fmt::print("  {:<24} {:>11.2f} {:>8.3f} {:>8.3f} {:>9.3f} {:>9.3f} {:>6.2f}\n", entrant.title,
             entrant.seconds, entrant.known_seconds, entrant.cache_seconds,
             static_cast<double>(entrant.rays) / entrant.seconds / 1e6,
             static_cast<double>(entrant.rays) / bare_seconds / 1e6, bare_seconds / entrant.seconds);
}

void compare(const Settings& settings, const Scene& scene, const World& world) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  std::unique_ptr<const ReuseEstimator> estimator;
  const double cache_seconds =
      cpu_seconds([&] { estimator = std::make_unique<const ReuseEstimator>(world, 1); });
  const Selection selection(*estimator, settings.labels);
  const auto walks = static_cast<std::uint32_t>((settings.walks + settings.batches - 1) / settings.batches);
  UniformEntrant sampled(world, selection, true, walks), exact(world, selection, false, walks);
  ReuseEntrant reuse(world, selection, *estimator, cache_seconds);
  const RayKinds kinds = ray_kinds(world, selection);
  std::vector<LabelCluster> clusters;
  for (const std::size_t item : selection.items) clusters.push_back(estimator->block(item).rows);
  BareRays bare(world, static_cast<std::size_t>(std::lround(kinds.shadow_packet)), clusters);
  for (std::uint64_t round = 0; round < settings.batches; ++round) {
    sampled.run();
    exact.run();
    reuse.run();
    bare.measure();
  }

  fmt::print("{}: {} triangles, {} of {} labels, {} candidates; {} batches of {} walks per label or of {}\n",
             scene.name, scene.mesh.triangles.size(), selection.labels.size(), scene.labels.size(),
             scene.transceivers.size(), settings.batches, walks, estimator->name());
  fmt::print("\n  CPU time, s; 10^6 rays/s     batches   direct    cache      rays      bare  share\n");
  const double walk_rate = bare.walks.per_second();
  print_rays(sampled, static_cast<double>(sampled.rays) / walk_rate);
  print_rays(exact, static_cast<double>(exact.rays) / walk_rate);
  print_rays(reuse, kinds.bare_seconds(bare) * static_cast<double>(settings.batches));
  const double rays = kinds.single + kinds.shadow + kinds.visibility;
  const auto print_kind = [&](const char* kind, double count, const Rate& rate) {
    fmt::print("    {:<22} {:>9.0f} % {:>36.3f}\n", kind, 100 * count / rays, rate.per_second() / 1e6);
  };
  print_kind("single rays", kinds.single, bare.single);
  print_kind("shadow rays", kinds.shadow, bare.shadow);
  print_kind("visibility rays", kinds.visibility, bare.visibility);
  const double share = static_cast<double>(sampled.rays) / sampled.seconds / walk_rate;
  fmt::print("  The baseline runs at {} half of its bare rate.\n", share >= 0.5 ? "more than" : "LESS THAN");
  fmt::print("\n  efficiency of reuse over             {:>8} {:>14} {:>9} {:>9}\n", "ratio", "without cache",
             "entries", "omitted");
  print_efficiency(scene, selection, reuse, sampled);
  print_efficiency(scene, selection, reuse, exact);
  fmt::print("\n  agreement of reuse with               {:>8} {:>8} {:>8} {:>8} {:>9}\n", "pooled z", "rms z",
             "largest", "% over 3", "values");
  print_agreement(reuse, sampled);
  print_agreement(reuse, exact);
}

void compare_caps(const Settings& settings, const Scene& scene, const World& world) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  std::vector<SpotRule> rules{{}};
  for (const double cap : {0.25, 0.35, 0.5, 0.7, 1.0, 2.0, 4.0})
    rules.push_back({.min_cap_distance = cap, .max_cap_distance = cap});
  std::vector<std::unique_ptr<const ReuseEstimator>> estimators;
  std::vector<std::unique_ptr<ReuseEntrant>> entrants;
  std::unique_ptr<const Selection> selection;
  for (const SpotRule& rule : rules) {
    ReuseEffort effort;
    effort.spots = rule;
    const double cache_seconds =
        cpu_seconds([&] { estimators.push_back(std::make_unique<const ReuseEstimator>(world, 1, effort)); });
    if (!selection) selection = std::make_unique<const Selection>(*estimators.back(), settings.labels);
    entrants.push_back(std::make_unique<ReuseEntrant>(world, *selection, *estimators.back(), cache_seconds));
  }
  for (std::uint64_t round = 0; round < settings.batches; ++round)
    for (const auto& entrant : entrants) entrant->run();
  fmt::print("{}: {} of {} labels, {} candidates; {} batches of {}\n", scene.name, selection->labels.size(),
             scene.labels.size(), scene.transceivers.size(), settings.batches, estimators[0]->name());
  fmt::print("  {:>8} {:>12} {:>18} {:>18}\n", "cap, m", "CPU time", "efficiency > 0.3", "> 0.02");
  for (std::size_t k = 0; k < entrants.size(); ++k) {
    const auto efficiency = [&](double above) {
      return efficiency_ratio(scene, *selection, *entrants[k], *entrants[0], above, min_contributions).ratio;
    };
    fmt::print("  {:>8} {:>12.3f} {:>18.3f} {:>18.3f}\n",
               k == 0 ? "default" : fmt::format("{:g}", rules[k].min_cap_distance),
               entrants[k]->seconds / entrants[0]->seconds, efficiency(0.3), efficiency(0.02));
  }
  fmt::print("\n");
}

void print_threads(const Scene& scene, std::uint64_t batches) {
  const ThreadScaling found = thread_scaling(scene, batches);
  fmt::print("\n  reuse, {} batches: {:.2f} s with one thread, {:.2f} s with {}: {:.2f} times as fast\n\n",
             found.batches, found.one, found.all, found.threads, found.one / found.all);
}

void print_growth(const std::vector<std::string>& stores) {
  fmt::print("{:<12} {:>7} {:>10} {:>9} {:>26} {:>9} {:>22}\n", "reuse in", "labels", "candidates",
             "clusters", "cache: CPU s, s, MB", "measured", "label x batch: ms, rays");
  for (const std::string& store : stores) {
    const Scene scene = open_scene(store);
    const Cost cost = cost_of_reuse(scene, 400, 4);
    fmt::print("{:<12} {:>7} {:>10} {:>9} {:>10.2f} {:>7.2f} {:>7.1f} {:>9} {:>20.3f} {:>6.0f}\n", store,
               scene.labels.size(), scene.transceivers.size(), cost.clusters, cost.cache_cpu_seconds,
               cost.cache_wall_seconds, cost.cache_bytes / 1e6, cost.measured_labels,
               1e3 * cost.label_batch_seconds, cost.rays);
  }
}

Settings parse(int argc, char** argv) {
  Settings settings;
  Words words(argc, argv);
  while (words.any_left()) {
    const std::string word = words.next();
    const auto number = [&] { return std::strtoull(words.value().c_str(), nullptr, 10); };
    if (word == "--quick") {
      settings.walks = 16000;
      settings.batches = 32;
      settings.labels = 100;
      settings.threads = false;
    } else if (word == "--growth") {
      settings.growth = true;
    } else if (word == "--caps") {
      settings.caps = true;
    } else if (word == "--before") {
      settings.earlier_program = words.value();
    } else if (word == "--against-paper") {
      settings.against_paper = true;
    } else if (word == "--seeds") {
      settings.over_seeds.seeds = number();
    } else if (word == "--samples") {
      settings.over_seeds.samples = number();
    } else if (word == "--reference") {
      settings.over_seeds.reference_samples = number();
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
  if (settings.batches < min_contributions)
    throw std::invalid_argument(fmt::format("--batches must be at least {}", min_contributions));
  // Without one seed there must still be a variance.
  if (settings.over_seeds.seeds < 3) throw std::invalid_argument("--seeds must be at least 3");
  if (settings.stores.empty()) {
    settings.stores = {"thesis", "grocery"};
    if (settings.growth) settings.stores.insert(settings.stores.end(), {"supermarket", "hypermarket"});
  }
  settings.over_seeds.stores = settings.stores;
  return settings;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Settings settings = parse(argc, argv);
    if (settings.growth) {
      print_growth(settings.stores);
      return 0;
    }
    if (!settings.earlier_program.empty())
      compare_with_program(settings.over_seeds, settings.earlier_program);
    if (settings.against_paper) compare_with_paper(settings.over_seeds);
    if (settings.against_paper || !settings.earlier_program.empty()) return 0;
    for (const std::string& store : settings.stores) {
      const Scene scene = open_scene(store);
      if (settings.caps) {
        compare_caps(settings, scene, World(scene));
        continue;
      }
      compare(settings, scene, World(scene));
      if (scene.labels.size() <= settings.labels)
        print_threads(scene, std::max<std::uint64_t>(16, settings.batches / 4));
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
