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

/// Workspace of one thread for share_point.
struct Sharing {
  struct Receiver {
    std::uint32_t index;
    double density;
  };
  std::vector<Receiver> receivers;
  std::vector<RayEnd> targets;
  std::vector<Transmittance> transmittances;
};

/// Path reuse (Bekaert, Sbert, Halton 2002): a point found by a ray of one receiver serves all receivers that
/// see it, with a weight that includes the sampling densities of all of them. Receiver c has n_c rays of
/// density p_c per area, of which the share P_c goes straight through panes of transmittance T_c. It takes
///
///     g_c p_c T_c / sum_k n_k p_k P_k
///
/// times the radiance (BalanceHeuristic; unbiased: docs/methods/reuse.md). `receivers` has size() and, for
/// each receiver c, end(c), rays(c) = n_c, density(c) = p_c, which is 0 if c cannot find the point, and
/// gain(c) = g_c. `transmittance` belongs to the finder, whose ray has reached the point. Calls
/// take(c, weight).
template <class Receivers, class Take>
void share_point(const World& world, const SurfacePoint& point, const Receivers& receivers,
                 std::uint32_t finder, const Transmittance& transmittance, Sharing& memory,
                 std::uint64_t& rays, const Take& take) {
  memory.receivers.clear();
  memory.targets.clear();
  for (std::uint32_t c = 0; c < receivers.size(); ++c) {
    if (c == finder) continue;
    const double density = receivers.density(c);
    if (!(density > 0)) continue;
    memory.receivers.push_back({c, density});
    memory.targets.push_back(receivers.end(c));
  }
  memory.transmittances.resize(memory.targets.size());
  world.rays.transmittances(point, memory.targets, memory.transmittances);
  rays += memory.targets.size();
  memory.receivers.push_back({finder, receivers.density(finder)});
  memory.transmittances.push_back(transmittance);

  BalanceHeuristic balance;
  for (std::size_t t = 0; t < memory.receivers.size(); ++t) {
    const auto& [c, density] = memory.receivers[t];
    balance.add(receivers.rays(c) * density * memory.transmittances[t].probability);
  }
  if (!balance.can_be_drawn()) return;
  for (std::size_t t = 0; t < memory.receivers.size(); ++t) {
    const auto& [c, density] = memory.receivers[t];
    if (memory.transmittances[t].share == 0) continue;
    take(c, balance.estimate(receivers.gain(c) * density * memory.transmittances[t].share));
  }
}

/// L - h at a vertex, in the two parts of PathVertex: the base without its exit factor, and the path's own.
struct ResidualRows {
  explicit ResidualRows(std::size_t groups) : base(groups), own(groups) {}
  void clear() {
    base.clear();
    own.clear();
  }

  LaneRow base, own;
};

/// The min probability that a path continues at a surface: near its albedo, in steps, so that runs that
/// differ a little in a reflectance take the same paths. 0 for surfaces that are not bright.
double survival_at(double albedo);

/// Numbers of rays and paths; tau is the smallest requirement.
struct ReuseEffort {
  std::uint32_t lookups = 128;  ///< rays per label and batch that only look up the cache
  std::uint32_t points = 3;     ///< K: first hits per label and batch at which paths start
  /// Share of tau. A unit whose importance at a vertex is larger always gets a shadow ray, other units get
  /// one with a probability in proportion. Multiplied by up to 4 where many units are in reach.
  double stake = 0.05;
  std::uint32_t gather_rays = 24;        ///< rays that look up the cache from such a first hit
  std::uint32_t later_gather_rays = 16;  ///< rays that look up the cache from a later vertex
  std::size_t group = 96;                ///< max number of vertices that share their continuations
  std::uint32_t spot_rays = 8;           ///< max rays from a unit, for a cluster or a group of vertices
  /// Factor on the rays from vertices around units that are close to a surface: there are few such vertices.
  std::uint32_t more_if_close = 8;
  SpotRule spots = {};
  /// Whether the cache's walks also start at units that shine mostly where labels' walks do not come, and
  /// small clusters then have more points.
  bool seeks_rare_light = true;
  bool is_hidden = false;  ///< units shine mostly there, which cells from elsewhere do not tell
  double survival = 0.7;   ///< min probability of a continuation; bright surfaces have survival_at
};

/// The effort where batches should be short rather than precise.
inline constexpr ReuseEffort small_batches{
    .lookups = 48, .points = 1, .gather_rays = 12, .later_gather_rays = 8};

/// Unbiased estimate of L - h, the radiance that leaves vertices minus its approximation by the cache, for
/// all units at once. At each vertex, shadow rays go to units chosen by importance, and several rays look up
/// the cache for the light of further bounces. One of these rays continues the path, and the estimate repeats
/// at its end. Vertices of a group share the continuations by their bases (share_point).
/// docs/methods/reuse.md defines the quantities.
class Residual {
 public:
  /// `requirement`: the smallest requirement. At a vertex, shadow rays consider all units that may give a
  /// twentieth of it there.
  Residual(const World& world, const UnitGroups& units, const RadianceCache& cache, const BrightSpots& spots,
           const RayTargets& targets, double requirement, const ReuseEffort& effort);

  /// Identifies the paths of a group.
  struct Key {
    std::uint64_t stream = 0;
    std::uint32_t batch = 0, group = 0;
  };

  /// A path that continues.
  struct Continuation {
    std::uint32_t parent;
    double weight;  ///< of the radiance from the new vertex to its parent, over the survival probability
    bool by_base;
    bool is_shared;
    Transmittance transmittance;  ///< of the straight connection from the parent
  };

  /// A ray that determines V in e V - e v, the direct light of a unit or emitting surface j at a vertex minus
  /// its approximation by the cache.
  struct ShadowRay {
    std::uint32_t lane_index = 0;  ///< UnitGroups::lane_index of j
    LightPoint light = {};         ///< on j
    double weight = 1;             ///< 1 / q_j; q_j is the probability that j gets a shadow ray
    double taken = 1;              ///< min(e, cap) / e; rays from bright spots bring the rest
    double h_base = 0, h_own = 0;  ///< radiance of min(e, cap) v in the cache, in the parts of PathVertex
  };

  /// Workspace of one thread.
  struct Scratch {
    struct Generation {
      std::vector<PathVertex> vertices;
      std::vector<ResidualRows> rows;
      std::vector<Continuation> continuations;  ///< the paths that led to the vertices
      std::vector<double> chances;              ///< q of each parent, to continue by its base
    };
    std::deque<Generation> generations;
    std::vector<std::uint16_t> list;            ///< groups of units in reach of a vertex
    std::vector<float> irradiance, importance;  ///< e_j and s_j of their lanes
    std::vector<std::uint8_t> zeros;            ///< v_j of groups that the cache omits
    std::vector<ShadowRay> shadow_rays;
    std::vector<RayEnd> targets;
    std::vector<float> shares;  ///< V
    std::vector<std::uint32_t> with_base;
    Sharing sharing;
    BrightSpots::Scratch spots;
  };

  /// Adds L - h of each vertex to its row; the rows are empty before.
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
  const RayTargets& targets_;
  double requirement_;
  float reach_;
  ReuseEffort effort_;
  bool any_loose_;
  double stake_factor_;  ///< factor on ReuseEffort::stake where many units are in reach, at least 1
};

}  // namespace shelfbeam
