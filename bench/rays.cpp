// How much of the ray library's speed the uniform estimator keeps: rays a second of the estimator against the
// bare rate of the same kinds of rays (from surface points of its walks, in its directions, to its units),
// alternating in one process on one thread.
//
//   build/release/bench_rays [STORE]      (default: the thesis environment)

#include <chrono>
#include <cstdint>
#include <exception>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/math/frame.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/scene/store.hpp"
#include "shelfbeam/scene/templates.hpp"
#include "shelfbeam/transport/label_walk.hpp"

namespace {

using namespace shelfbeam;

struct RaySample {
  SurfacePoint from;
  Vec3 direction, target;
};

template <class Work>
double seconds(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<RaySample> rays_of_walks(const World& world, std::size_t count) {
  std::vector<RaySample> samples;
  const auto n = static_cast<std::uint32_t>(world.emitters.size());
  for (std::uint32_t walk = 0; samples.size() < count; ++walk) {
    SurfacePoint from = world.receivers.point(walk % world.receivers.size(), 0.5, 0.5);
    for (std::uint32_t vertex = 0; vertex < 3; ++vertex) {  // about the mean length of a walk at albedo 0.7
      const auto u = philox({vertex, walk, 0, 0}, 1);
      const Vec3 local = sample_cosine_hemisphere(to_unit(u[1]), to_unit(u[2]));
      const Vec3 direction = Frame::about(from.normal).to_world(local);
      const Vec3 target = world.emitters.point(to_index(u[0], n), 0.5, 0.5).position;
      samples.push_back({from, direction, target});
      const auto hit = world.rays.intersect(from, direction);
      if (!hit) break;
      from = hit->point;
      if (dot(from.normal, direction) > 0) from.normal = -from.normal;
    }
  }
  return samples;
}

void compare(const Scene& scene) {
  const World world(scene);
  const PathRules paper{.strategy = Strategy::nee};
  const auto samples = rays_of_walks(world, 300000);
  Tally tally(world.emitters.size(), 2);

  double bare = 0, estimator = 0;
  std::uint64_t bare_rays = 0, seen = 0;
  for (std::uint32_t round = 0; round < 8; ++round) {
    bare += seconds([&] {
      for (const RaySample& s : samples) {
        seen += world.rays.intersect(s.from, s.direction) ? 1 : 0;
        seen += world.rays.passage(s.from, s.target).share > 0 ? 1 : 0;
      }
    });
    bare_rays += 2 * samples.size();
    estimator += seconds([&] {
      for (std::uint32_t k = 0; k < 100000; ++k) {
        const std::size_t i = k % scene.labels.size();
        walk_from_label(world, i, {hash64(scene.labels[i].id), round, k}, paper, tally);
      }
    });
  }
  const double bare_rate = static_cast<double>(bare_rays) / bare;
  const double estimator_rate = static_cast<double>(tally.rays) / estimator;
  fmt::print("{}: {} triangles, {} labels, {} candidates; one thread\n", scene.name,
             scene.mesh.triangles.size(), scene.labels.size(), scene.transceivers.size());
  fmt::print("bare rays          {:8.3f} million a second ({:.0f} % reach something or see the unit)\n",
             bare_rate / 1e6, 100 * static_cast<double>(seen) / static_cast<double>(bare_rays));
  fmt::print("uniform estimator  {:8.3f} million a second\nshare              {:8.2f}\n",
             estimator_rate / 1e6, estimator_rate / bare_rate);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Store store =
        argc > 1 ? read_store(argv[1])
                 : parse_store(std::string(find_template("thesis").files[0].content), "thesis", ".");
    compare(make_scene(store));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
