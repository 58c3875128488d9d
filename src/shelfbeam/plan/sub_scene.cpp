#include "shelfbeam/plan/sub_scene.hpp"

#include <utility>

namespace shelfbeam {

namespace {

template <class Device>
std::vector<Device> those(const std::vector<Device>& all, std::span<const std::uint32_t> wanted) {
  std::vector<Device> some;
  some.reserve(wanted.size());
  for (const std::uint32_t k : wanted) some.push_back(all[k]);
  return some;
}

}  // namespace

Scene sub_scene(const Scene& scene, std::span<const std::uint32_t> labels,
                std::span<const std::uint32_t> transceivers) {
  Scene part = scene;
  part.store_hash.clear();
  part.labels = those(scene.labels, labels);
  part.transceivers = those(scene.transceivers, transceivers);
  return part;
}

}  // namespace shelfbeam
