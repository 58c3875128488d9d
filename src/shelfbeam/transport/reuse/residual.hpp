#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "shelfbeam/transport/reuse/bright_spots.hpp"
#include "shelfbeam/transport/reuse/path_vertex.hpp"
#include "shelfbeam/transport/world/next_event.hpp"
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

/// L - h at a vertex, in the two parts of PathVertex: of the base, without its exit, and the path's own.
struct ResidualRows {
  explicit ResidualRows(std::size_t groups) : base(groups), own(groups) {}
  void clear() {
    base.clear();
    own.clear();
  }

  LaneRow base, own;
};

/// How much is spent where on paths; tau is the smallest requirement.
struct ReuseEffort {
  std::uint32_t lookups = 128;  ///< rays a label and batch that only look the cache up
  std::uint32_t points = 3;     ///< K: first hits a label and batch from which paths start
  /// Of tau: units with more at stake at a vertex get a shadow ray, others one in proportion. More where
  /// units are many.
  double stake = 0.05;
  std::uint32_t gather_rays = 24;        ///< that look the cache up at such a point,
  std::uint32_t later_gather_rays = 16;  ///< and at later vertices
  std::size_t group = 96;                ///< vertices that share their continuations
  std::uint32_t spot_rays = 8;           ///< from a unit at most, for a cluster or the vertices of a group
  SpotRule spots = {};
  double survival = 0.7;  ///< least chance of a continuation; brighter surfaces have their albedo
};

/// The difference between the radiance that leaves vertices and what the cache says, L - h, for all units at
/// once, without bias: shadow rays to units chosen by what is at stake, several rays that look up the cache
/// for what comes over further bounces, and one that goes on to where the same is asked of it. Vertices of a
/// group share those that go on by their base (share_point). docs/methods/reuse.md has the quantities.
class Residual {
 public:
  /// `requirement`: the smallest signal that matters. Units that may give a twentieth of it to a vertex are
  /// all considered there.
  Residual(const World& world, const UnitGroups& units, const RadianceCache& cache, const BrightSpots& spots,
           double requirement, const ReuseEffort& effort);

  /// Identifies the paths of a group.
  struct Key {
    std::uint64_t stream = 0;
    std::uint32_t batch = 0, group = 0;
  };

  /// A path that goes on.
  struct Continuation {
    std::uint32_t parent;
    double weight;  ///< of what the new vertex sends to its parent, over the chance of going on
    bool by_base;
    bool is_shared;
    Passage passage;  ///< straight from the parent
  };

  /// A ray that asks for V in e V - e v, the straight light of a unit or shining surface j at a vertex less
  /// what the cache has of it.
  struct ShadowRay {
    std::uint32_t place = 0;       ///< of j, UnitGroups::place
    LightPoint light = {};         ///< on j
    double weight = 1;             ///< 1 / q_j, q_j being the chance with which j is asked
    double taken = 1;              ///< min(e, cap) / e: the share that is not left to rays from bright spots
    double h_base = 0, h_own = 0;  ///< what the cache makes of min(e, cap) v, in the parts of PathVertex
  };

  /// Memory that one thread works in.
  struct Scratch {
    struct Generation {
      std::vector<PathVertex> vertices;
      std::vector<ResidualRows> rows;
      std::vector<Continuation> continuations;  ///< that have led to the vertices
      std::vector<double> chances;              ///< of their parents to go on by the base
    };
    std::deque<Generation> generations;
    std::vector<std::uint16_t> list;            ///< groups of units in reach of a vertex,
    std::vector<float> irradiance, importance;  ///< e_j and s_j of their lanes,
    std::vector<std::uint8_t> zeros;            ///< and v_j where the cache knows nothing
    std::vector<ShadowRay> shadow_rays;
    std::vector<Vec3> targets;
    std::vector<float> shares;  ///< V
    std::vector<std::uint32_t> with_base;
    Sharing sharing;
    BrightSpots::Scratch spots;
  };

  /// Puts the differences into the rows, which are clear, one a vertex.
  void estimate(std::span<const PathVertex> vertices, const Key& key, Scratch& scratch,
                std::span<ResidualRows> rows, std::uint64_t& rays) const;

 private:
  struct Found;
  struct Sharers;
  void extend(std::span<const PathVertex> vertices, const Key& key, std::uint32_t generation,
              Scratch& scratch, std::span<ResidualRows> rows, Scratch::Generation& next,
              std::uint64_t& rays) const;
  double weigh_units(const PathVertex& vertex, Scratch& scratch) const;
  void choose_units(const PathVertex& vertex, RandomStream& random, Scratch& scratch) const;
  void add_direct(const PathVertex& vertex, RandomStream& random, Scratch& scratch, ResidualRows& rows,
                  std::uint64_t& rays) const;
  void add_far(const PathVertex& vertex, RandomStream& random, ResidualRows& rows, std::uint64_t& rays) const;
  void add_spots(std::span<const PathVertex> vertices, const Key& key, std::uint32_t generation,
                 Scratch& scratch, std::span<ResidualRows> rows, std::uint64_t& rays) const;
  void subtract_indirect(const PathVertex& vertex, ResidualRows& rows) const;
  std::optional<Found> gather(const PathVertex& vertex, bool by_base, std::uint32_t count,
                              std::uint64_t points, RandomStream& random, LaneRow& row,
                              std::uint64_t& rays) const;
  void share(std::span<const PathVertex> vertices, const std::vector<double>& chances,
             const Continuation& from, const PathVertex& found, const ResidualRows& carried, Scratch& scratch,
             std::span<ResidualRows> rows, std::uint64_t& rays) const;

  const World& world_;
  const UnitGroups& units_;
  const RadianceCache& cache_;
  const BrightSpots& spots_;
  double requirement_;
  float reach_;
  ReuseEffort effort_;
  bool any_loose_;
  double crowd_;  ///< of units in reach, 1 or more: so many times more must be at stake for a shadow ray
};

}  // namespace shelfbeam
