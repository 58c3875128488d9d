#include "shelfbeam/scene/build/blocks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "shelfbeam/material/material.hpp"

namespace shelfbeam {

namespace {

std::vector<const Part*> blocks_of(const Scene& scene) {
  std::vector<const Part*> blocks;
  for (const Part& part : scene.parts)
    if (part.kind != PartKind::mesh && is_opaque(scene.materials[part.material.value].material))
      blocks.push_back(&part);
  return blocks;
}

}  // namespace

BoxIndex index_of(const std::vector<const Part*>& parts) {
  return BoxIndex::over(parts, [](const Part* part) { return bounds_of(*part); });
}

Bounds bounds_of(const Part& part) {
  Bounds bounds;
  for (const auto& [x, y] : part.footprint) {
    bounds.include(Vec3{x, y, part.bottom});
    bounds.include(Vec3{x, y, part.top});
  }
  return bounds;
}

void Stretch::clip(double distance, double slope) {
  if (std::abs(slope) < 1e-12)
    end = distance > 1e-9 ? end : begin;
  else if (slope > 0)
    begin = std::max(begin, -distance / slope);
  else
    end = std::min(end, -distance / slope);
}

Stretch stretch_within(const Part& block, const Vec3& p, const Vec3& direction, double inset) {
  Stretch stretch;
  for (std::size_t k = 0; k < block.footprint.size(); ++k) {
    const auto &a = block.footprint[k], &b = block.footprint[(k + 1) % block.footprint.size()];
    const double x = b[0] - a[0], y = b[1] - a[1], edge = std::hypot(x, y);
    if (edge > 0)
      stretch.clip((x * (p.y - a[1]) - y * (p.x - a[0])) / edge - inset,
                   (x * direction.y - y * direction.x) / edge);
  }
  stretch.clip(p.z - block.bottom - inset, direction.z);
  stretch.clip(block.top - p.z - inset, -direction.z);
  return stretch;
}

Blocks::Blocks(const Scene& scene, std::size_t max_visits)
    : scene_(scene),
      blocks_(blocks_of(scene)),
      index_(index_of(blocks_)),
      max_visits_(max_visits),
      has_limit_(max_visits < std::numeric_limits<std::size_t>::max()) {}

std::optional<Blocks::Hit> Blocks::next(const Vec3& p, const Vec3& direction) const {
  std::optional<Hit> nearest;
  const Part* first = nullptr;  // of equally near blocks, the first in the store
  any(Bounds{p, p}.wider_by(too_near), [&](const Part& part) {
    const Stretch stretch = stretch_within(part, p, direction);
    if (stretch.end - stretch.begin < rounding || stretch.end < rounding || stretch.begin > too_near)
      return false;
    if (!nearest || stretch.begin < nearest->distance ||
        (stretch.begin == nearest->distance && &part < first)) {
      nearest = Hit{&scene_.fixtures[part.fixture].id, stretch.begin};
      first = &part;
    }
    return false;
  });
  return nearest;
}

bool Blocks::contain(const Vec3& p) const {
  return any(Bounds{p, p},
             [&](const Part& part) {
               const Stretch stretch = stretch_within(part, p, {0, 0, 1});
               return stretch.begin < -rounding && stretch.end > rounding;
             }) ||
         is_exhausted();
}

}  // namespace shelfbeam
