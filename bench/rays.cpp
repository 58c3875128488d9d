// Measures the share of the ray library's speed that the uniform estimator retains: rays per second of the
// estimator against the bare rate of the same kinds of rays (from surface points of its walks, in its
// directions, to its units). Both alternate in one process on one thread.
//
//   build/release/bench_rays [STORE]      (default: the thesis environment)

#include <cstdint>
#include <exception>

#include <fmt/format.h>

#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/transport/uniform/walks.hpp"

#include "bare_rays.hpp"
#include "support.hpp"

namespace {

using namespace shelfbeam;

void compare(const Scene& scene) {
  const World world(scene);
  const PathRules paper{.strategy = Strategy::nee};
  bench::BareRays bare(world);
  Tally tally(world.emitters.size(), 2);

  double estimator = 0;
  for (std::uint32_t round = 0; round < 100; ++round) {
    bare.measure();
    estimator += bench::cpu_seconds([&] {
      for (std::uint32_t k = 0; k < 8000; ++k) {
        const std::size_t i = (std::size_t{round} * 8000 + k) % scene.labels.size();
        walk_from_label(world, i, {hash64(scene.labels[i].id), round, k}, paper, tally);
      }
    });
  }
  const double estimator_rate = static_cast<double>(tally.rays) / estimator;
  fmt::print("{}: {} triangles, {} labels, {} candidates; one thread\n", scene.name,
             scene.mesh.triangles.size(), scene.labels.size(), scene.transceivers.size());
  fmt::print("bare rays          {:8.3f} million per second ({:.0f} % hit a surface or see the unit)\n",
             bare.walks.per_second() / 1e6, 100 * bare.hits / bare.walks.rays);
  fmt::print("uniform estimator  {:8.3f} million per second\nshare              {:8.2f}\n",
             estimator_rate / 1e6, estimator_rate / bare.walks.per_second());
}

}  // namespace

int main(int argc, char** argv) {
  try {
    compare(bench::open_scene(argc > 1 ? argv[1] : "thesis"));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
