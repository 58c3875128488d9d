#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/inspection/checks.hpp"
#include "shelfbeam/material/material.hpp"
#include "shelfbeam/math/box_index.hpp"
#include "shelfbeam/math/frame.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/scene/label/label_name.hpp"

namespace shelfbeam {

namespace {

/// Labels and units in groups between which light can travel. Straight connections and random walks join
/// groups, so two groups are separate if no walk leads from one to the other: through no door, window or gap.
class LightGroups {
 public:
  explicit LightGroups(const Inspected& store)
      : store_(store),
        labels_(store.labels.size()),
        units_(store.scene.transceivers.size()),
        parent_(labels_ + units_),
        has_partner_(labels_ + units_),
        is_unknown_(labels_ + units_),
        is_on_wall_(units_),
        index_(index_of_positions(store.scene.transceivers)) {
    std::iota(parent_.begin(), parent_.end(), 0U);
    const Vec3 size = store.scene.upper - store.scene.lower;
    reach_ = 2 * std::sqrt(std::max(size.x * size.y, 1.0) / static_cast<double>(units_));
    for (std::uint32_t i = 0; i < labels_; ++i)
      if (!joins_directly(i)) walk_from(i, walks_per_device);
    for (std::uint32_t j = 0; j < units_; ++j)
      if (const std::uint32_t node = unit(j); is_alone(node)) walk_from(node, walks_per_device);
    join_groups();
  }

  std::uint32_t unit(std::uint32_t j) const { return static_cast<std::uint32_t>(labels_) + j; }
  /// Whether the device was examined to the end.
  bool is_known(std::uint32_t node) const { return !is_unknown_[node]; }
  std::uint32_t group(std::uint32_t node) const {
    while (parent_[node] != node) node = parent_[node] = parent_[parent_[node]];
    return node;
  }

 private:
  static constexpr std::uint32_t walks_per_device = 16, walks_per_group = 256, bounces = 8;
  static constexpr std::size_t tests = 8;         // units tested per point
  static constexpr std::size_t max_groups = 100;  // examined again
  // Steps of all walks, about a second. Devices that are left then count as connected.
  static constexpr std::size_t max_steps = 200'000;

  void join(std::uint32_t a, std::uint32_t b) {
    a = group(a);
    b = group(b);
    has_partner_[a] = has_partner_[b] = true;
    parent_[std::max(a, b)] = std::min(a, b);
  }
  bool is_alone(std::uint32_t node) const { return parent_[node] == node && !has_partner_[node]; }

  bool is_inside_block(std::uint32_t node) const { return store_.blocks.contain(origin(node).position); }

  // A unit exactly on a wall is seen from both sides of it, and therefore joins only one group.
  bool may_join(std::uint32_t j) {
    if (is_alone(unit(j))) return true;
    if (!is_on_wall_[j]) {
      constexpr double near = 0.005;
      const Vec3& p = store_.scene.transceivers[j].position;
      bool touches = false;
      for (const Vec3& side : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}}) {
        const Vec3 start = p + side * near;
        const auto hit = store_.rays.intersect({start, -side}, -side);
        touches = touches || (hit && length(hit->point.position - start) < 2 * near);
      }
      is_on_wall_[j] = touches;
    }
    return !*is_on_wall_[j];
  }

  // The device as the origin of light, or its end.
  SurfacePoint origin(std::uint32_t node) const {
    if (node < labels_) {
      const Label& label = store_.scene.labels[store_.labels[node]];
      return {label.position, label.normal};
    }
    const Transceiver& unit = store_.scene.transceivers[node - labels_];
    return {unit.position, unit.axis};
  }

  // Calls `use` for some units near a point, until it returns true.
  template <class Use>
  bool any_near(const Vec3& p, const Use& use) const {
    std::size_t count = 0;
    for (double reach = reach_; count == 0 && reach < 1e6; reach *= 2) {
      Bounds box{p, p};
      box = box.wider_by(reach);
      box.low.z = store_.scene.lower.z - 1e5;
      box.high.z = store_.scene.upper.z + 1e5;
      bool found = false;
      index_.any(box, [&](std::uint32_t j) {
        found = use(j);
        return found || ++count == tests;
      });
      if (found) return true;
    }
    return false;
  }

  bool sees(const SurfacePoint& from, std::uint32_t j) const {
    const Vec3& to = store_.scene.transceivers[j].position;
    return dot(to - from.position, from.normal) > 0 && store_.rays.transmittance(from, to).share > 0;
  }

  bool joins_directly(std::uint32_t label) {
    store_.expect_running();
    const SurfacePoint from = origin(label);
    return any_near(from.position, [&](std::uint32_t j) {
      if (!may_join(j) || !sees(from, j)) return false;
      join(label, unit(j));
      return true;
    });
  }

  // Joins the first unit of another group that a walk sees. Glass is passed straight.
  bool walk_from(std::uint32_t node, std::uint32_t walks) {
    if (is_inside_block(node)) return false;
    if (node >= labels_ && !may_join(node - static_cast<std::uint32_t>(labels_))) return false;
    if (steps_ > max_steps) {
      is_unknown_[node] = true;
      return false;
    }
    for (std::uint32_t walk = 0; walk < walks; ++walk) {
      store_.expect_running();
      SurfacePoint at = origin(node);
      for (std::uint32_t bounce = 0; bounce < bounces; ++bounce) {
        ++steps_;
        const auto random = philox({node, walk, bounce, 0}, 0x77616c6c73);
        const double u = to_uniform(random[0]), phi = 2 * pi * to_uniform(random[1]), r = std::sqrt(u);
        const Vec3 direction =
            Frame::about(at.normal).to_world({r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u)});
        const auto next = surface(at, direction);
        if (!next) break;
        at = *next;
        const auto joins = [&](std::uint32_t j) {
          if (group(unit(j)) == group(node) || !may_join(j) || !sees(at, j)) return false;
          join(node, unit(j));
          return true;
        };
        const auto any = static_cast<std::uint32_t>(units_);
        if (any_near(at.position, joins) || joins(to_index(random[2], any)) ||
            joins(to_index(random[3], any)))
          return true;
      }
    }
    return false;
  }

  // The first opaque surface, with the normal towards the origin of the ray.
  std::optional<SurfacePoint> surface(SurfacePoint from, const Vec3& direction) const {
    constexpr int max_panes = 16;
    for (int pane = 0; pane < max_panes; ++pane) {
      const auto hit = store_.rays.intersect(from, direction);
      if (!hit) return std::nullopt;
      from = hit->point;
      if (!is_opaque(store_.scene.materials[hit->material.value].material)) continue;
      if (dot(from.normal, direction) > 0) from.normal = -from.normal;
      return from;
    }
    return std::nullopt;
  }

  // Walks once more, and longer, from the members of every group except the largest, until no group grows.
  void join_groups() {
    bool has_joined = true;
    while (has_joined) {
      has_joined = false;
      std::map<std::uint32_t, std::vector<std::uint32_t>> members;
      for (std::uint32_t node = 0; node < parent_.size(); ++node) members[group(node)].push_back(node);
      const auto largest = std::max_element(members.begin(), members.end(), [](const auto& a, const auto& b) {
                             return a.second.size() < b.second.size();
                           })->first;
      std::size_t examined = 0;
      for (const auto& [first, nodes] : members) {
        if (group(first) == group(largest)) continue;
        if (++examined > max_groups) break;
        const std::size_t starts = std::min<std::size_t>(nodes.size(), 16);
        bool joins = false;
        for (std::size_t k = 0; k < starts && !joins; ++k)
          joins = walk_from(nodes[k * nodes.size() / starts],
                            walks_per_group / static_cast<std::uint32_t>(starts));
        has_joined = has_joined || joins;
      }
    }
  }

  const Inspected& store_;
  std::size_t labels_, units_;
  mutable std::vector<std::uint32_t> parent_;  // union-find; searches shorten the paths
  std::vector<bool> has_partner_, is_unknown_;
  std::vector<std::optional<bool>> is_on_wall_;  // examined when needed
  std::size_t steps_ = 0;                        // of all walks
  BoxIndex index_;
  double reach_ = 0;  // m; a square of this half side contains several units
};

std::string position_text(const Vec3& p) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z);
}

}  // namespace

void warn_of_separated(const Inspected& store, WarningList& warnings) {
  constexpr double small_group = 0.1;  // of the labels
  const Scene& scene = store.scene;
  const LightGroups groups(store);
  struct Members {
    std::size_t labels = 0, units = 0;
  };
  std::map<std::uint32_t, Members> members;
  for (std::uint32_t i = 0; i < store.labels.size(); ++i) ++members[groups.group(i)].labels;
  for (std::uint32_t j = 0; j < scene.transceivers.size(); ++j) ++members[groups.group(groups.unit(j))].units;
  const double few = small_group * static_cast<double>(store.labels.size());
  for (std::uint32_t i = 0; i < store.labels.size(); ++i) {
    const Label& label = scene.labels[store.labels[i]];
    const auto& [labels, units] = members.at(groups.group(i));
    if ((units > 0 && static_cast<double>(labels) >= few) || !groups.is_known(i) ||
        store.blocks.contain(label.position))
      continue;
    const std::string at = position_text(label.position),
                      others = units == 0 ? "all transceivers" : "most labels";
    warnings.add_text(
        FindingCode::label_separated, store.sources.labels[store.labels[i]],
        fmt::format("label {} at {} is separated from {} by closed surfaces, so that no light reaches it; "
                    "usually some light passes between all parts of a shop; check its position, the walls, "
                    "and doors of an opaque material",
                    label_name(label.id, label.description), at, others),
        {label.id, at, others});
  }
  for (std::uint32_t j = 0; j < scene.transceivers.size(); ++j) {
    const Transceiver& unit = scene.transceivers[j];
    if (members.at(groups.group(groups.unit(j))).labels > 0 || !groups.is_known(groups.unit(j)) ||
        store.blocks.contain(unit.position))
      continue;
    warnings.add(FindingCode::unit_separated, store.sources.transceivers[j],
                 "transceiver '{}' at {} is separated from all labels by closed surfaces; usually light "
                 "reaches labels from every candidate; correct its position, or cover it with 'keep_out'",
                 unit.id, position_text(unit.position));
  }
}

}  // namespace shelfbeam
