#pragma once

#include <optional>

#include "shelfbeam/transport/cache/lane_kernels.hpp"
#include "shelfbeam/transport/cache/radiance_cache.hpp"
#include "shelfbeam/transport/cache/unit_groups.hpp"
#include "shelfbeam/transport/world/direct.hpp"
#include "shelfbeam/transport/world/specular_chain.hpp"

namespace shelfbeam {

/// A vertex at which paths scatter, with its row of the cache. The light that leaves it has two parts
/// (SurfaceGuide): the part of the base, without its exit factor, is the same for all receivers that see the
/// vertex; the other part belongs to this path alone.
struct PathVertex {
  PathVertex(const World& world, const RadianceCache& cache, const ChainEnd& where);

  bool has_base() const { return guide->has_base(); }
  /// Share of the base's light that leaves towards a position.
  double exit_towards(const Vec3& position) const;

  /// f cos for light from a source: `whole` for all lobes, back along the path; `base` for the base without
  /// its exit factor.
  struct Reflection {
    double whole = 0, base = 0;
  };
  Reflection reflected(const Vec3& to_source) const;

  struct Parts {
    DirectSignal base, own;
  };
  /// Splits a reflected signal into the two parts; `straight` is the Reflection of its straight connection.
  /// Under a coat, light of mirror paths belongs to the path alone.
  Parts split(const Reflection& straight, const DirectSignal& signal) const;

  struct Scattered {
    Vec3 direction;
    double weight;  ///< of the radiance from `direction`
    Departure departure;
  };
  Scattered scatter_by_base(double u1, double u2) const;
  /// Samples the lobes other than the base; no value if the light is absorbed.
  std::optional<Scattered> scatter_otherwise(double u_lobe, double u1, double u2) const;

  /// The cache's approximation of f for a unit: of the base without its exit factor, and of the rest.
  struct Guided {
    float base, own;
  };
  Guided guided(const UnitGroups& units, std::size_t g, std::size_t lane, const LanePoint& point) const;

  /// Adds `weight` times the cache's radiance back along the path.
  void look_up(const UnitGroups& units, float weight, LaneRow& to) const;

  ChainEnd end;
  RadianceCache::Row row;
  const Material* material;
  const SurfaceGuide* guide;
  LaneScatter scatter;     ///< set if SurfaceGuide::is_detailed
  bool is_capped = false;  ///< whether irradiance is limited to the caps of BrightSpots
  double exit = 1;         ///< share of the base's light that leaves back along the path
  double own_albedo = 0;   ///< albedo for indirect irradiance in the cache, besides the base's
  double albedo = 0;       ///< total albedo for light along the path, specular lobes included
};

}  // namespace shelfbeam
