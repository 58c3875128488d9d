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
#include "shelfbeam/transport/uniform_walk.hpp"

namespace {

using namespace shelfbeam;

struct RaySample {
  Vec3 origin, normal, direction, target;
};

template <class Work>
double seconds(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<RaySample> rays_of_walks(const WalkScene& world, std::size_t count) {
  std::vector<RaySample> samples;
  const auto n = static_cast<std::uint32_t>(world.emitters.size());
  for (std::uint32_t walk = 0; samples.size() < count; ++walk) {
    const Label& label = world.scene.labels[walk % world.scene.labels.size()];
    Vec3 position = label.position, normal = label.normal;
    for (std::uint32_t vertex = 0; vertex < 3; ++vertex) {  // about the mean length of a walk at albedo 0.7
      const auto u = philox({vertex, walk, 0, 0}, 1);
      const Vec3 local = sample_cosine_hemisphere(to_unit(u[1]), to_unit(u[2]));
      const Vec3 direction = Frame::about(normal).to_world(local);
      samples.push_back({position, normal, direction, world.emitters.position(to_index(u[0], n))});
      const auto hit = world.rays.intersect(position, normal, direction);
      if (!hit) break;
      position = hit->position;
      normal = hit->normal;
    }
  }
  return samples;
}

void compare(const Scene& scene) {
  const RayScene rays(scene.mesh);
  const Emitters emitters(scene);
  const WalkScene world{scene, rays, emitters};
  const auto samples = rays_of_walks(world, 300000);
  std::vector<double> reflected(emitters.size()), direct(emitters.size());

  double bare = 0, estimator = 0;
  std::uint64_t bare_rays = 0, estimator_rays = 0, seen = 0;
  for (std::uint32_t round = 0; round < 8; ++round) {
    bare += seconds([&] {
      for (const RaySample& s : samples) {
        seen += rays.intersect(s.origin, s.normal, s.direction) ? 1 : 0;
        seen += rays.occluded(s.origin, s.normal, s.target) ? 0 : 1;
      }
    });
    bare_rays += 2 * samples.size();
    estimator += seconds([&] {
      for (std::uint32_t k = 0; k < 100000; ++k) {
        const Label& label = scene.labels[k % scene.labels.size()];
        estimator_rays += uniform_walk(world, label, {hash64(label.id), round, k}, reflected, direct);
      }
    });
  }
  const double bare_rate = static_cast<double>(bare_rays) / bare;
  const double estimator_rate = static_cast<double>(estimator_rays) / estimator;
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
