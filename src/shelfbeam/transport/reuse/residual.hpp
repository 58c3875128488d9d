#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "shelfbeam/transport/reuse/bright_spots.hpp"
#include "shelfbeam/transport/reuse/path_vertex.hpp"
#include "shelfbeam/transport/reuse/shared_point.hpp"

namespace shelfbeam {

/// L - h at a vertex, in the two parts of PathVertex: of the base, without its exit, and the path's own.
struct ResidualRows {
  explicit ResidualRows(std::size_t groups) : base(groups), own(groups) {}
  void clear() {
    base.clear();
    own.clear();
  }

  LaneRow base, own;
};

/// How much is spent where on paths.
struct ReuseEffort {
  std::uint32_t lookups = 128;  ///< rays a label and batch that only look the cache up
  std::uint32_t points = 3;     ///< first hits a label and batch from which paths start
  double stake = 0.05;          ///< of the requirement: units with more at stake get a shadow ray, others
  double later_stake = 0.05;  ///< one in proportion; the second at later vertices. More where units are many
  std::uint32_t tails = 24;   ///< rays that look the cache up at such a point,
  std::uint32_t later_tails = 16;  ///< and at later vertices
  std::size_t group = 96;          ///< vertices that share their continuations
  std::uint32_t spot_rays =
      8;  ///< from a unit beside a surface at most, for a cluster, or vertices of a group
  SpotRule spots = {};
  double survival = 0.7;  ///< least chance of a continuation; brighter surfaces have their albedo
};

/// The difference between the radiance that leaves vertices and what the cache says, L - h, for all units at
/// once, without bias: shadow rays to units chosen by what is at stake, several rays that look up the cache
/// for what comes over further bounces, and one that goes on to where the same is asked of it. Vertices of a
/// group share those that go on by their base (path reuse with the balance heuristic, Bekaert et al. 2002):
/// each is weighted by the densities with which all of the group would have sent it.
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

  /// Memory that one thread works in.
  struct Scratch {
    struct Generation {
      std::vector<PathVertex> vertices;
      std::vector<ResidualRows> rows;
      std::vector<Continuation> continuations;  ///< that have led to the vertices
      std::vector<double> chances;              ///< of their parents to go on by the base
    };
    std::deque<Generation> generations;
    std::vector<float> irradiance, importance, shares;
    std::vector<std::uint8_t> zeros;
    std::vector<std::uint16_t> list;
    std::vector<Vec3> targets;
    std::vector<std::uint32_t> places, with_base;
    std::vector<double> inverse_probability;
    std::vector<double> known_base, known_own, taken;
    std::vector<LightPoint> lights;
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
  void add_direct(const PathVertex& vertex, double stake, RandomStream& random, Scratch& scratch,
                  ResidualRows& rows, std::uint64_t& rays) const;
  void add_far(const PathVertex& vertex, RandomStream& random, ResidualRows& rows, std::uint64_t& rays) const;
  void add_spots(std::span<const PathVertex> vertices, const Key& key, std::uint32_t generation,
                 Scratch& scratch, std::span<ResidualRows> rows, std::uint64_t& rays) const;
  void subtract_indirect(const PathVertex& vertex, ResidualRows& rows) const;
  std::optional<Found> gather(const PathVertex& vertex, bool by_base, std::uint32_t tails,
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
