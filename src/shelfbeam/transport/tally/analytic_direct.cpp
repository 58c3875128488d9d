#include "shelfbeam/transport/tally/analytic_direct.hpp"

#include <atomic>
#include <vector>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/transport/world/direct.hpp"

namespace shelfbeam::detail {

namespace {

bool has_mirrored(const World& world, const PathRules& rules) {
  return world.mirrors.size() > 0 && rules.uses_images(true, true);
}

}  // namespace

std::size_t AnalyticDirect::bytes(const World& world, const PathRules& rules) {
  if (rules.samples_direct) return 0;
  return world.receivers.size() * world.emitters.size() * sizeof(float) *
         (has_mirrored(world, rules) ? 2 : 1);
}

AnalyticDirect::AnalyticDirect(const World& world, const PathRules& rules, std::span<const LabelId> labels,
                               const RunControl& control)
    : columns_(world.emitters.size()) {
  if (rules.samples_direct) return;
  const std::size_t entries = world.receivers.size() * columns_;
  straight_.resize(entries);
  if (has_mirrored(world, rules)) mirrored_.resize(entries);
  std::atomic<std::uint64_t> rays{0};
  std::atomic<bool> cancelled{false};
  parallel_for_ranges(labels.size(), [&](std::size_t first, std::size_t last) {
    for (const LabelId i : labels.subspan(first, last - first)) {
      if (control.cancelled()) {
        cancelled = true;
        return;
      }
      std::uint64_t of_row = 0;
      if (mirrored_.empty() && world.receivers.is_point(i)) {
        of_row = fill_row(world, i);
      } else {
        for (std::size_t j = 0; j < columns_; ++j) {
          if (!is_point_to_point(world, i, j)) continue;
          const DirectSignal signal = direct_between_points(world, i, j, rules);
          straight_[i * columns_ + j] = static_cast<float>(signal.straight);
          if (!mirrored_.empty()) mirrored_[i * columns_ + j] = static_cast<float>(signal.mirrored);
          of_row += signal.rays;
        }
      }
      rays.fetch_add(of_row, std::memory_order_relaxed);
    }
  });
  rays_ = rays;
  complete_ = !cancelled;
}

// Straight connections only: many rays from one point.
std::uint64_t AnalyticDirect::fill_row(const World& world, std::size_t i) {
  const SurfacePoint at = world.receivers.point(i, 0, 0);
  std::vector<std::size_t> columns;
  std::vector<double> values;
  std::vector<RayEnd> targets;
  for (std::size_t j = 0; j < columns_; ++j) {
    if (!world.emitters.is_point(j)) continue;
    const LightPoint light = world.emitters.point(j, 0, 0);
    const DirectSignal open = light_from(
        world, j, light, at, false, [&](const Vec3& d) { return world.receivers.response(i, d); },
        [] { return 1.0; });
    if (open.straight == 0) continue;
    columns.push_back(j);
    values.push_back(open.straight);
    targets.push_back(light.position);
  }
  std::vector<float> shares(targets.size());
  world.rays.shares(at, targets, shares);
  for (std::size_t t = 0; t < columns.size(); ++t)
    straight_[i * columns_ + columns[t]] = static_cast<float>(values[t] * static_cast<double>(shares[t]));
  return targets.size();
}

}  // namespace shelfbeam::detail
