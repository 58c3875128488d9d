#include "shelfbeam/transport/cache/lane_kernels.hpp"

#include <cmath>

#include "shelfbeam/math/cpu_vectors.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/transport/cache/profile_irradiance.hpp"

namespace shelfbeam {

namespace {

template <LaneProfile profile, class Group>
SHELFBEAM_INLINE inline float in_lane(const Group& group, const float* table, int steps, const LanePoint& p,
                                      std::size_t k) {
  return profile_irradiance<profile>({group.x[k] - p.x, group.y[k] - p.y, group.z[k] - p.z},
                                     {p.nx, p.ny, p.nz}, {group.ax[k], group.ay[k], group.az[k]},
                                     group.scale[k], table, steps);
}

template <LaneProfile profile, class Group, class Use>
SHELFBEAM_INLINE inline void in_lanes(const Group& group, const float* table, int steps, const LanePoint& p,
                                      const Use& use) {
  SHELFBEAM_VECTORIZE
  for (std::size_t k = 0; k < lanes; ++k) use(k, in_lane<profile>(group, table, steps, p, k));
}

template <class Group, class Use>
SHELFBEAM_INLINE inline void for_lanes(const Group& group, const float* table, int steps, const LanePoint& p,
                                       const Use& use) {
  switch (group.profile) {
    case LaneProfile::sine:
      in_lanes<LaneProfile::sine>(group, table, steps, p, use);
      break;
    case LaneProfile::isotropic:
      in_lanes<LaneProfile::isotropic>(group, table, steps, p, use);
      break;
    case LaneProfile::lambertian:
      in_lanes<LaneProfile::lambertian>(group, table, steps, p, use);
      break;
    case LaneProfile::table:
      in_lanes<LaneProfile::table>(group, table, steps, p, use);
  }
}

// A local copy, so that one loop keeps it in registers and on the stack.
struct Facets : LaneScatter, LaneMaterial {
  Facets() = default;
  explicit Facets(const LaneScatter& scatter) : LaneScatter(scatter), LaneMaterial(*scatter.material) {}
};

SHELFBEAM_INLINE inline float on_curve(const CosineCurve& curve, float cosine) {
  float value = curve.factor[CosineCurve::nodes - 1];
  for (std::size_t k = CosineCurve::nodes - 1; k-- > 0;)
    value = value * (cosine - CosineCurve::at[k]) + curve.factor[k];
  return value;
}

// The direction l to a unit: its cosine `ln` and its component `lx` along x of the surface; and o + l: its
// squared length, which is small at grazing angles, and its component `hx`.
struct Way {
  float ln, lx, squared, hx;
};

template <class Group>
SHELFBEAM_INLINE inline Way way_to(const Group& group, const LanePoint& p, const Facets& f, std::size_t k) {
  const float dx = group.x[k] - p.x, dy = group.y[k] - p.y, dz = group.z[k] - p.z;
  const float whole = dx * dx + dy * dy + dz * dz;
  const float squared = whole > min_squared_distance ? whole : min_squared_distance;
  const float inverse = 1 / std::sqrt(squared);
  const float facing = (p.nx * dx + p.ny * dy + p.nz * dz) * inverse;
  const float hx = f.ox + dx * inverse, hy = f.oy + dy * inverse, hz = f.oz + dz * inverse;
  const float sum = hx * hx + hy * hy + hz * hz;
  return {facing > 0 ? facing < 1 ? facing : 1 : 0, (f.tx * dx + f.ty * dy + f.tz * dz) * inverse,
          sum > 1e-12F ? sum < 4 ? sum : 4 : 1e-12F, f.tx * hx + f.ty * hy + f.tz * hz};
}

// F D G / (4 cos cos) (2.23) of microfacets, isotropic or not: GGX (2.29), (2.31), or Beckmann's. Beckmann's
// exponential (2.24) is approximated by (1 + x / 64)^-64, which is high by 1 % at x = 1 and by 13 % at x = 4,
// its masking by the rational approximation of (2.28).
template <bool beckmann>
SHELFBEAM_INLINE inline float highlight(const Facets& f, const Way& way) {
  const float ln = way.ln;
  const float facing = (f.on + ln) * (f.on + ln) / way.squared;  // cos^2 of the facets
  const float across = facing < 1 ? 1 - facing : 0;
  const float slope = f.narrow * across + f.skew * (way.hx * way.hx / way.squared);
  const float side = f.more * way.lx * way.lx;
  const float curve = on_curve(f.fresnel, std::sqrt(way.squared) / 2);
  const float fresnel = curve > 0 ? curve : 0;
  if constexpr (beckmann) {
    const float level = 1 - across > 1e-3F ? 1 - across : 1e-3F;
    float power = 1 + slope / (64 * f.alpha2 * level);
    for (int square = 0; square < 6; ++square) power *= power;
    const float root = std::sqrt(f.across2 * (1 - ln * ln) + side + 1e-12F);
    const float a = ln / root;
    const float seen = (3.535F + 2.181F * a) / ((1 + (2.276F + 2.577F * a) * a) * root);  // G1 / cos
    const float g = a < 1.6F ? seen : 1 / ln;
    return f.highlight * g / (static_cast<float>(pi) * f.alpha2 * level * level * power) * fresnel;
  } else {
    const float d = slope + f.alpha2 * (1 - across);
    const float g = ln + std::sqrt(f.across2 + (1 - f.across2) * ln * ln + side);
    return f.highlight * 2 * f.alpha2 / (static_cast<float>(pi) * d * d * g) * fresnel;
  }
}

// Calls use(k, cosine at the point, highlight) for all lanes.
template <class Group, class Use>
SHELFBEAM_INLINE inline void for_highlights(const Group& group, const LanePoint& p, const Facets& f,
                                            const Use& use) {
  if (f.is_beckmann) {
    SHELFBEAM_VECTORIZE
    for (std::size_t k = 0; k < lanes; ++k) {
      const Way way = way_to(group, p, f, k);
      use(k, way.ln, highlight<true>(f, way));
    }
  } else {
    SHELFBEAM_VECTORIZE
    for (std::size_t k = 0; k < lanes; ++k) {
      const Way way = way_to(group, p, f, k);
      use(k, way.ln, highlight<false>(f, way));
    }
  }
}

// A separate loop, because compilers vectorise a loop over types of different width by the narrowest type.
SHELFBEAM_INLINE inline void unpack(const std::uint8_t* share, float* part) {
  SHELFBEAM_VECTORIZE
  for (std::size_t k = 0; k < lanes; ++k) part[k] = PackedLane::share(share[k]);
}

}  // namespace

SHELFBEAM_FOR_EACH_CPU
void LaneKernels::irradiance(const UnitGroups& groups, std::size_t g, const LanePoint& point,
                             LaneValues& result) {
  const auto& group = groups.groups_[g];
  const LanePoint p = point;
  float* const to = result.data();
  for_lanes(group, groups.tables_.data() + group.table, UnitGroups::table_steps, p,
            [&](std::size_t k, float e) SHELFBEAM_INLINE { to[k] = e; });
}

SHELFBEAM_FOR_EACH_CPU
void LaneKernels::add_irradiance(const UnitGroups& groups, const std::uint16_t* list, std::size_t count,
                                 const LanePoint& point, bool is_capped, float weight,
                                 const std::uint8_t* share, const std::uint16_t* indirect, float* sums) {
  const LanePoint p = point;
  for (std::size_t c = 0; c < count; ++c) {
    const auto& group = groups.groups_[list[c]];
    float* const sum = sums + list[c] * lanes;
    const std::uint8_t* const s = share + c * lanes;
    const std::uint16_t* const d = indirect + c * lanes;
    const float* const cap = is_capped ? group.cap.data() : groups.no_cap_.data();
    alignas(64) float part[lanes], rest[lanes];
    unpack(s, part);
    SHELFBEAM_VECTORIZE
    for (std::size_t k = 0; k < lanes; ++k) rest[k] = PackedLane::value(d[k]);
    for_lanes(group, groups.tables_.data() + group.table, UnitGroups::table_steps, p,
              [&](std::size_t k, float e)
                  SHELFBEAM_INLINE { sum[k] += weight * ((e < cap[k] ? e : cap[k]) * part[k] + rest[k]); });
  }
}

SHELFBEAM_FOR_EACH_CPU
void LaneKernels::add_radiance(const UnitGroups& groups, const std::uint16_t* list, std::size_t count,
                               const LanePoint& point, const LaneScatter& scatter, bool is_capped,
                               float weight, float indirect_factor, const std::uint8_t* share,
                               const std::uint16_t* indirect, float* sums) {
  const LanePoint p = point;
  const Facets facets(scatter);
  for (std::size_t c = 0; c < count; ++c) {
    const auto& group = groups.groups_[list[c]];
    float* const sum = sums + list[c] * lanes;
    const float* const cap = is_capped ? group.cap.data() : groups.no_cap_.data();
    alignas(64) float part[lanes], rest[lanes], f[lanes];
    unpack(share + c * lanes, part);
    const std::uint16_t* const d = indirect + c * lanes;
    SHELFBEAM_VECTORIZE
    for (std::size_t k = 0; k < lanes; ++k) rest[k] = indirect_factor * PackedLane::value(d[k]);
    if (facets.highlight > 0) {
      for_highlights(group, p, facets, [&](std::size_t k, float ln, float highlight) SHELFBEAM_INLINE {
        f[k] = facets.base * on_curve(facets.entry, ln) + highlight;
      });
    } else {
      SHELFBEAM_VECTORIZE
      for (std::size_t k = 0; k < lanes; ++k)
        f[k] = facets.base * on_curve(facets.entry, way_to(group, p, facets, k).ln);
    }
    for_lanes(group, groups.tables_.data() + group.table, UnitGroups::table_steps, p,
              [&](std::size_t k, float e) SHELFBEAM_INLINE {
                sum[k] += weight * ((e < cap[k] ? e : cap[k]) * part[k] * f[k] + rest[k]);
              });
  }
}

LaneKernels::Parts LaneKernels::parts(const UnitGroups& groups, std::size_t g, std::size_t lane,
                                      const LanePoint& point, const LaneScatter& scatter) {
  const Facets facets(scatter);
  const Way way = way_to(groups.groups_[g], point, facets, lane);
  return {on_curve(facets.entry, way.ln), facets.highlight == 0 ? 0
                                          : facets.is_beckmann  ? highlight<true>(facets, way)
                                                                : highlight<false>(facets, way)};
}

SHELFBEAM_FOR_EACH_CPU
float LaneKernels::importance(const UnitGroups& groups, const std::uint16_t* list, std::size_t count,
                              const LanePoint& point, bool is_capped, const std::uint8_t* share, float floor,
                              const LaneScatter* scatter, float* irradiance, float* importance) {
  const LanePoint p = point;
  const Facets facets = scatter != nullptr ? Facets(*scatter) : Facets();
  alignas(64) float total[lanes] = {};
  for (std::size_t c = 0; c < count; ++c) {
    const auto& group = groups.groups_[list[c]];
    const std::uint8_t* const s = share + c * lanes;
    const float* const cap = is_capped ? group.cap.data() : groups.no_cap_.data();
    float* const whole = irradiance + c * lanes;
    float* const at_stake = importance + c * lanes;
    const float threshold = floor > 0 ? floor * groups.bound(list[c], p) : 0;
    alignas(64) float part[lanes], more[lanes];
    unpack(s, part);
    SHELFBEAM_VECTORIZE
    for (std::size_t k = 0; k < lanes; ++k) more[k] = 1;
    if (facets.highlight > 0)
      for_highlights(group, p, facets, [&](std::size_t k, float, float highlight) SHELFBEAM_INLINE {
        more[k] += static_cast<float>(pi) * highlight;
      });
    for_lanes(group, groups.tables_.data() + group.table, UnitGroups::table_steps, p,
              [&](std::size_t k, float e) SHELFBEAM_INLINE {
                whole[k] = e;
                const float used = e < cap[k] ? e : cap[k];
                const float value =
                    used * more[k] * (std::sqrt(std::abs(part[k] * (1 - part[k]))) + 0.05F) + threshold;
                at_stake[k] = value;
                total[k] += value;
              });
  }
  float sum = 0;
  for (std::size_t k = 0; k < lanes; ++k) sum += total[k];
  return sum;
}

SHELFBEAM_FOR_EACH_CPU
void LaneKernels::add_listed(const std::uint16_t* list, std::size_t count, float weight,
                             const std::uint16_t* values, float* sums) {
  for (std::size_t c = 0; c < count; ++c) {
    const std::uint16_t* const from = values + c * lanes;
    float* const to = sums + list[c] * lanes;
    SHELFBEAM_VECTORIZE
    for (std::size_t k = 0; k < lanes; ++k) to[k] += weight * PackedLane::value(from[k]);
  }
}

SHELFBEAM_FOR_EACH_CPU
void LaneKernels::add_packed(std::size_t count, float weight, const std::uint16_t* from, float* to) {
  SHELFBEAM_VECTORIZE
  for (std::size_t k = 0; k < count * lanes; ++k) to[k] += weight * PackedLane::value(from[k]);
}

SHELFBEAM_FOR_EACH_CPU
void LaneKernels::add(const std::uint16_t* list, std::size_t count, float weight, const float* values,
                      float* sums) {
  for (std::size_t c = 0; c < count; ++c) {
    const float* const from = values + list[c] * lanes;
    float* const to = sums + list[c] * lanes;
    SHELFBEAM_VECTORIZE
    for (std::size_t k = 0; k < lanes; ++k) to[k] += weight * from[k];
  }
}

}  // namespace shelfbeam
