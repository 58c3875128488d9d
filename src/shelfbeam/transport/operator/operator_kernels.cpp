#include "shelfbeam/transport/operator/operator_kernels.hpp"

#include "shelfbeam/transport/cache/lane_kernels.hpp"

namespace shelfbeam {

namespace {

template <LaneProfile profile>
SHELFBEAM_INLINE inline void light(const OperatorKernels::Unit& unit, const OperatorKernels::Points& p,
                                   std::size_t count, float* result) {
  SHELFBEAM_VECTORIZE
  for (std::size_t k = 0; k < count; ++k)
    result[k] = profile_irradiance<profile>(
        {unit.position.x - p.x[k], unit.position.y - p.y[k], unit.position.z - p.z[k]},
        {p.nx[k], p.ny[k], p.nz[k]}, unit.axis, unit.scale, nullptr, 0);
}

template <bool with_squares>
SHELFBEAM_INLINE inline void add(const OperatorKernels::Rows& all, const std::uint32_t* rows,
                                 const float* values, const float* deviations, std::size_t count, float* sums,
                                 float* squares) {
  constexpr std::size_t group = OperatorKernels::group;
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint16_t* weights = all.weights + std::size_t{all.first[rows[k]]} * group;
    const unsigned mask = all.masks[rows[k]];
    const float value = values[k];
    const float deviation = with_squares ? deviations[k] : 0;
    for (std::size_t g = 0; g < OperatorKernels::max_groups; ++g) {
      if ((mask >> g & 1U) == 0) continue;
      float* const sum = sums + g * group;
      float* const square = squares + g * group;
      SHELFBEAM_VECTORIZE
      for (std::size_t c = 0; c < group; ++c) {
        const float weight = PackedLane::value(weights[c]);
        sum[c] += weight * value;
        if constexpr (with_squares) {
          const float term = weight * deviation;
          square[c] += term * term;
        }
      }
      weights += group;
    }
  }
}

}  // namespace

SHELFBEAM_FOR_EACH_CPU
void OperatorKernels::irradiance(const Unit& unit, const Points& points, std::size_t count, float* result) {
  const Unit own = unit;
  const Points p = points;
  if (own.profile == LaneProfile::sine)
    light<LaneProfile::sine>(own, p, count, result);
  else if (own.profile == LaneProfile::isotropic)
    light<LaneProfile::isotropic>(own, p, count, result);
  else
    light<LaneProfile::lambertian>(own, p, count, result);
}

SHELFBEAM_FOR_EACH_CPU
void OperatorKernels::add_rows(const Rows& all, const std::uint32_t* rows, const float* values,
                               std::size_t count, float* sums) {
  add<false>(all, rows, values, nullptr, count, sums, sums);
}

SHELFBEAM_FOR_EACH_CPU
void OperatorKernels::add_rows(const Rows& all, const std::uint32_t* rows, const float* values,
                               const float* deviations, std::size_t count, float* sums, float* squares) {
  add<true>(all, rows, values, deviations, count, sums, squares);
}

}  // namespace shelfbeam
