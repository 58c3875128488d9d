#include "shelfbeam/transport/detail/known_light.hpp"

#include <atomic>

#include "shelfbeam/transport/detail/parallel.hpp"
#include "shelfbeam/transport/direct.hpp"

namespace shelfbeam::detail {

namespace {

bool has_mirrored(const World& world, const PathRules& rules) {
  return world.mirrors.size() > 0 && rules.uses_images(true, true);
}

}  // namespace

std::size_t KnownLight::bytes(const World& world, const PathRules& rules) {
  if (rules.samples_direct) return 0;
  return world.receivers.size() * world.emitters.size() * sizeof(float) *
         (has_mirrored(world, rules) ? 2 : 1);
}

KnownLight::KnownLight(const World& world, const PathRules& rules, const RunControl& control)
    : columns_(world.emitters.size()) {
  if (rules.samples_direct) return;
  const std::size_t entries = world.receivers.size() * columns_;
  straight_.resize(entries);
  if (has_mirrored(world, rules)) mirrored_.resize(entries);
  std::atomic<std::uint64_t> rays{0};
  std::atomic<bool> cancelled{false};
  for_parts(world.receivers.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      if (control.cancelled()) {
        cancelled = true;
        return;
      }
      std::uint64_t of_row = 0;
      for (std::size_t j = 0; j < columns_; ++j) {
        if (!is_point_to_point(world, i, j)) continue;
        const DirectSignal signal = direct_between_points(world, i, j, rules);
        straight_[i * columns_ + j] = static_cast<float>(signal.straight);
        if (!mirrored_.empty()) mirrored_[i * columns_ + j] = static_cast<float>(signal.mirrored);
        of_row += signal.rays;
      }
      rays.fetch_add(of_row, std::memory_order_relaxed);
    }
  });
  rays_ = rays;
  complete_ = !cancelled;
}

}  // namespace shelfbeam::detail
