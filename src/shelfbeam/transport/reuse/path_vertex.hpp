#pragma once

#include <optional>

#include "shelfbeam/transport/cache/lane_kernels.hpp"
#include "shelfbeam/transport/cache/radiance_cache.hpp"
#include "shelfbeam/transport/cache/unit_groups.hpp"
#include "shelfbeam/transport/world/direct.hpp"
#include "shelfbeam/transport/world/specular_chain.hpp"

namespace shelfbeam {

/// A vertex at which paths scatter, and what is known of it. Its light is in two parts (SurfaceGuide): that
/// of the base, without its exit, is the same for all who see the vertex; the rest is that of the path alone.
struct PathVertex {
  PathVertex(const World& world, const RadianceCache& cache, const ChainEnd& where);

  bool has_base() const { return guide->has_base(); }
  /// Share of the base's light that leaves towards a place.
  double exit_towards(const Vec3& place) const;

  /// f cos towards a source: of all that leaves towards where the path came from, and of the base without
  /// its exit.
  struct Reflection {
    double whole = 0, base = 0;
  };
  Reflection reflected(const Vec3& to_source) const;

  struct Parts {
    DirectSignal base, own;
  };
  /// Of light that has been reflected, the straight one in this way. What comes over a mirror is all the
  /// path's own where there is a coat.
  Parts split(const Reflection& straight, const DirectSignal& signal) const;

  struct Scattered {
    Vec3 direction;
    double weight;  ///< of the radiance that comes from there, for the part asked for
    Departure departure;
  };
  Scattered scatter_by_base(double u1, double u2) const;
  /// By what is not the base; nothing when the light is absorbed.
  std::optional<Scattered> scatter_otherwise(double u_lobe, double u1, double u2) const;

  /// What the cache takes f to be for a unit: of the base without its exit, and otherwise.
  struct Guided {
    float base, own;
  };
  Guided guided(const UnitGroups& units, std::size_t g, std::size_t lane, const LanePoint& point) const;

  /// Adds the cache's radiance towards where the path came from.
  void look_up(const UnitGroups& units, float weight, LaneRow& to) const;

  ChainEnd end;
  RadianceCache::Row row;
  const Material* material;
  const SurfaceGuide* guide;
  LaneScatter scatter;     ///< where the guide knows more than one number
  bool is_capped = false;  ///< the light of bright spots is not asked for (BrightSpots)
  double exit = 1;         ///< share of the base's light that leaves towards where the path came from
  double own_albedo = 0;   ///< share of indirect irradiance that the cache takes to leave besides the base's
  double albedo = 0;       ///< share of light from there that is reflected in all, mirrors included
};

}  // namespace shelfbeam
