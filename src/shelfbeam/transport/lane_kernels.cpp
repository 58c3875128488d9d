#include "shelfbeam/transport/lane_kernels.hpp"

#include <cmath>

// Function multiversioning resolves before sanitizers have started, which they do not survive.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define SHELFBEAM_FOR_EACH_CPU __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#define SHELFBEAM_INLINE __attribute__((always_inline)) inline
#else
#define SHELFBEAM_FOR_EACH_CPU
#define SHELFBEAM_INLINE inline
#endif

namespace shelfbeam {

namespace {

struct Lanes {
  float at_unit[lanes];   // distance times the cosine at the unit, at the point the same with its cosine
  float at_point[lanes];  // times the unit's scale
  float squared[lanes], inverse[lanes];  // squared distance
};

// A unit nearer than this gives what it would from there: only a guide is wanted.
constexpr float least_squared_distance = 1e-6F;

}  // namespace

// A friend's inner part, so that it may see a group.
struct LaneLoops {
  template <class Group>
  static SHELFBEAM_INLINE void aim(const Group& group, const LanePoint& p, Lanes& out) {
    for (std::size_t k = 0; k < lanes; ++k) {
      const float dx = group.x[k] - p.x, dy = group.y[k] - p.y, dz = group.z[k] - p.z;
      const float squared = dx * dx + dy * dy + dz * dz;
      out.squared[k] = squared > least_squared_distance ? squared : least_squared_distance;
      out.inverse[k] = 1 / out.squared[k];
      const float at_point = p.nx * dx + p.ny * dy + p.nz * dz;
      out.at_point[k] = (at_point > 0 ? at_point : 0) * group.scale[k];
      out.at_unit[k] = -(group.ax[k] * dx + group.ay[k] * dy + group.az[k] * dz);
    }
  }

  // I(theta) cos / d^2 with as few roots and divisions as each profile allows.
  template <class Group>
  static SHELFBEAM_INLINE void irradiance(const Group& group, int profile, const float* table, int steps,
                                          const LanePoint& p, float* result) {
    Lanes at;
    aim(group, p, at);
    switch (profile) {
      case 0:
        for (std::size_t k = 0; k < lanes; ++k) {
          const float c = at.at_unit[k] > 0 ? at.at_unit[k] : 0;
          const float across = at.squared[k] - c * c;
          result[k] = 2 * c * at.at_point[k] * std::sqrt((across > 0 ? across : 0) * at.inverse[k]) *
                      at.inverse[k] * at.inverse[k];
        }
        break;
      case 1:
        for (std::size_t k = 0; k < lanes; ++k)
          result[k] = at.at_unit[k] > 0 ? at.at_point[k] * at.inverse[k] * std::sqrt(at.inverse[k]) : 0;
        break;
      case 2:
        for (std::size_t k = 0; k < lanes; ++k)
          result[k] = at.at_point[k] * (at.at_unit[k] > 0 ? at.at_unit[k] : 0) * at.inverse[k] * at.inverse[k];
        break;
      default:
        for (std::size_t k = 0; k < lanes; ++k) {
          const float root = std::sqrt(at.inverse[k]);
          const float cosine = at.at_unit[k] * root;
          const float c = cosine < -1 ? -1 : cosine > 1 ? 1 : cosine;
          const float place = (1 + c) / 2 * static_cast<float>(steps);
          int below = static_cast<int>(place);
          below = below < steps ? below : steps - 1;
          const float part = place - static_cast<float>(below);
          result[k] = at.at_point[k] * at.inverse[k] * root *
                      (table[below] + part * (table[below + 1] - table[below]));
        }
    }
  }
};

SHELFBEAM_FOR_EACH_CPU
void LaneKernels::irradiance(const UnitGroups& groups, std::size_t g, const LanePoint& point,
                             LaneValues& result) {
  const auto& group = groups.groups_[g];
  LaneLoops::irradiance(group, static_cast<int>(group.profile), groups.tables_.data() + group.table,
                        UnitGroups::table_steps, point, result.data());
}

SHELFBEAM_FOR_EACH_CPU
void LaneKernels::add_irradiance(const UnitGroups& groups, const std::uint16_t* list, std::size_t count,
                                 const LanePoint& point, bool is_capped, float weight, const float* share,
                                 const float* indirect, float* sums) {
  for (std::size_t c = 0; c < count; ++c) {
    const auto& group = groups.groups_[list[c]];
    alignas(64) float e[lanes];
    LaneLoops::irradiance(group, static_cast<int>(group.profile), groups.tables_.data() + group.table,
                          UnitGroups::table_steps, point, e);
    float* sum = sums + list[c] * lanes;
    const float* s = share + c * lanes;
    const float* d = indirect + c * lanes;
    if (is_capped)
      for (std::size_t k = 0; k < lanes; ++k) e[k] = e[k] < group.cap[k] ? e[k] : group.cap[k];
    for (std::size_t k = 0; k < lanes; ++k) sum[k] += weight * (e[k] * s[k] + d[k]);
  }
}

SHELFBEAM_FOR_EACH_CPU
float LaneKernels::importance(const UnitGroups& groups, const std::uint16_t* list, std::size_t count,
                              const LanePoint& point, bool is_capped, const float* share, float floor,
                              float* irradiance, float* importance) {
  alignas(64) float total[lanes] = {};
  for (std::size_t c = 0; c < count; ++c) {
    const auto& group = groups.groups_[list[c]];
    alignas(64) float e[lanes];
    LaneLoops::irradiance(group, static_cast<int>(group.profile), groups.tables_.data() + group.table,
                          UnitGroups::table_steps, point, e);
    const float* s = share + c * lanes;
    for (std::size_t k = 0; k < lanes; ++k) {
      irradiance[c * lanes + k] = e[k];
      const float used = is_capped && e[k] > group.cap[k] ? group.cap[k] : e[k];
      const float at_stake = used * (std::sqrt(std::abs(s[k] * (1 - s[k]))) + 0.1F) + floor;
      importance[c * lanes + k] = at_stake;
      total[k] += at_stake;
    }
  }
  float sum = 0;
  for (std::size_t k = 0; k < lanes; ++k) sum += total[k];
  return sum;
}

SHELFBEAM_FOR_EACH_CPU
void LaneKernels::add_listed(const std::uint16_t* list, std::size_t count, float weight, const float* values,
                             float* sums) {
  for (std::size_t c = 0; c < count; ++c) {
    const float* from = values + c * lanes;
    float* to = sums + list[c] * lanes;
    for (std::size_t k = 0; k < lanes; ++k) to[k] += weight * from[k];
  }
}

SHELFBEAM_FOR_EACH_CPU
void LaneKernels::add(const std::uint16_t* list, std::size_t count, float weight, const float* values,
                      float* sums) {
  for (std::size_t c = 0; c < count; ++c) {
    const float* from = values + list[c] * lanes;
    float* to = sums + list[c] * lanes;
    for (std::size_t k = 0; k < lanes; ++k) to[k] += weight * from[k];
  }
}

}  // namespace shelfbeam
