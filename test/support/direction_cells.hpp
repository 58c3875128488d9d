#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/math/warp.hpp"

namespace shelfbeam::test {

/// Equal cells in (cos theta, phi) over the sphere, for chi-square tests of sampled directions.
class DirectionCells {
 public:
  DirectionCells(std::size_t rings, std::size_t sectors) : rings_(rings), sectors_(sectors) {}

  std::size_t size() const { return rings_ * sectors_; }

  std::size_t cell(const Vec3& d) const {
    const double phi = std::atan2(d.y, d.x) + pi;
    const auto ring =
        std::min(rings_ - 1, static_cast<std::size_t>((d.z + 1) / 2 * static_cast<double>(rings_)));
    const auto sector =
        std::min(sectors_ - 1, static_cast<std::size_t>(phi / (2 * pi) * static_cast<double>(sectors_)));
    return ring * sectors_ + sector;
  }

  /// Integral of a density per solid angle over each cell times `total`, by midpoints on a fine grid.
  template <class Density>
  std::vector<double> expected(const Density& density, double total, std::size_t fine = 32) const {
    std::vector<double> result(size());
    const double dz = 2.0 / static_cast<double>(rings_ * fine),
                 dphi = 2 * pi / static_cast<double>(sectors_ * fine);
    for (std::size_t r = 0; r < rings_ * fine; ++r)
      for (std::size_t s = 0; s < sectors_ * fine; ++s) {
        const double z = -1 + (static_cast<double>(r) + 0.5) * dz;
        const double phi = -pi + (static_cast<double>(s) + 0.5) * dphi;
        const double across = std::sqrt(1 - z * z);
        result[(r / fine) * sectors_ + s / fine] +=
            density(Vec3{across * std::cos(phi), across * std::sin(phi), z}) * dz * dphi * total;
      }
    return result;
  }

 private:
  std::size_t rings_, sectors_;
};

}  // namespace shelfbeam::test
