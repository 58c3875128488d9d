#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/transport/world/mis_weights.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam {

/// Memory that one thread shares points in.
struct Sharing {
  struct Receiver {
    std::uint32_t index;
    double density;
  };
  std::vector<Receiver> receivers;
  std::vector<Vec3> targets;
  std::vector<Passage> passages;
};

/// Path reuse (Bekaert, Sbert, Halton 2002): a point that a ray of one receiver has found serves all
/// receivers that see it, weighted by the densities with which all of them would have found it. With n_c rays
/// of density p_c per area, of which the share P_c goes straight on through panes that keep T_c of the light,
/// receiver c takes
///
///     g_c p_c T_c / sum_k n_k p_k P_k
///
/// times the radiance (BalanceHeuristic; no bias: docs/methods/reuse.md). `receivers` has size(), and for
/// each one position(c), rays(c) = n_c, density(c) = p_c, 0 where it cannot find the point, and gain(c) =
/// g_c. `passage` is that of the finder, whose own ray has got through. Calls take(c, weight).
template <class Receivers, class Take>
void share_point(const World& world, const SurfacePoint& point, const Receivers& receivers,
                 std::uint32_t finder, const Passage& passage, Sharing& memory, std::uint64_t& rays,
                 const Take& take) {
  memory.receivers.clear();
  memory.targets.clear();
  for (std::uint32_t c = 0; c < receivers.size(); ++c) {
    if (c == finder) continue;
    const double density = receivers.density(c);
    if (!(density > 0)) continue;
    memory.receivers.push_back({c, density});
    memory.targets.push_back(receivers.position(c));
  }
  memory.passages.resize(memory.targets.size());
  world.rays.passages(point, memory.targets, memory.passages);
  rays += memory.targets.size();
  memory.receivers.push_back({finder, receivers.density(finder)});
  memory.passages.push_back(passage);

  BalanceHeuristic balance;
  for (std::size_t t = 0; t < memory.receivers.size(); ++t) {
    const auto& [c, density] = memory.receivers[t];
    balance.add(receivers.rays(c) * density * memory.passages[t].probability);
  }
  if (!balance.can_be_drawn()) return;
  for (std::size_t t = 0; t < memory.receivers.size(); ++t) {
    const auto& [c, density] = memory.receivers[t];
    if (memory.passages[t].share == 0) continue;
    take(c, balance.estimate(receivers.gain(c) * density * memory.passages[t].share));
  }
}

}  // namespace shelfbeam
