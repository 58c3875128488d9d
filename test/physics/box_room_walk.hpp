#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "shelfbeam/math/random.hpp"
#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/stats/moments.hpp"

namespace shelfbeam::test {

/// What may be wrong with an estimator, on purpose.
struct Mistakes {
  bool no_cosine_at_surfaces = false;
  bool no_cosine_at_the_label = false;
  int extra_units = 0;  ///< the weight of a connection is n + extra_units instead of n
};

/// The uniform estimator for an empty box of one albedo with sin 2 theta units of 1 W/sr that look down,
/// written anew: rays meet the walls in closed form, nothing is shadowed, and no line is shared with the
/// program.
class BoxRoomWalk {
 public:
  BoxRoomWalk(const Vec3& size, double albedo, std::vector<Vec3> units, Mistakes mistakes)
      : size_(size), albedo_(albedo), units_(std::move(units)), mistakes_(mistakes) {}

  /// Signal of a cosine label from each unit.
  std::vector<Moments> estimate(const Vec3& position, const Vec3& normal, std::uint32_t samples,
                                std::uint64_t seed) const {
    std::vector<Moments> result(units_.size());
    std::vector<double> sample(units_.size());
    for (std::uint32_t s = 0; s < samples; ++s) {
      std::fill(sample.begin(), sample.end(), 0.0);
      walk(position, normal, s, seed, sample);
      for (std::size_t j = 0; j < sample.size(); ++j) result[j].add(sample[j]);
    }
    return result;
  }

 private:
  void walk(Vec3 x, Vec3 n, std::uint32_t s, std::uint64_t seed, std::vector<double>& sample) const {
    double weight =
        1;  // irradiance a unit of radiance over the hemisphere brings: rho / pi * pi from here on
    for (std::uint32_t vertex = 0;; ++vertex) {
      const auto u = philox({s, vertex, 77, 0}, seed);
      const auto j = static_cast<std::size_t>(to_unit(u[0]) * static_cast<double>(units_.size()));
      const bool drop = vertex == 0 ? mistakes_.no_cosine_at_the_label : mistakes_.no_cosine_at_surfaces;
      sample[j] +=
          weight * (static_cast<double>(units_.size()) + mistakes_.extra_units) * irradiance(x, n, j, drop);
      if (to_unit(u[3]) >= albedo_) return;  // roulette with the albedo keeps the weight
      // A direction about an axis: the walls are axis-aligned.
      const double r = std::sqrt(to_unit(u[1])), phi = 2 * pi * to_unit(u[2]), up = std::sqrt(1 - r * r);
      const Vec3 t = std::abs(n.x) > 0.5 ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
      const Vec3 a = normalized(cross(n, t)), b = cross(n, a);
      advance(x, n, a * (r * std::cos(phi)) + b * (r * std::sin(phi)) + n * up);
    }
  }

  double irradiance(const Vec3& x, const Vec3& n, std::size_t j, bool drop_cosine) const {
    const Vec3 d = units_[j] - x;
    const double distance = length(d), cosine = dot(d, n) / distance, down = d.z / distance;
    if (cosine <= 0 || down <= 0) return 0;
    const double intensity = std::sin(2 * std::acos(std::min(1.0, down)));
    return intensity * (drop_cosine ? 1 : cosine) / (distance * distance);
  }

  void advance(Vec3& x, Vec3& n, const Vec3& d) const {
    double nearest = 1e300;
    Vec3 wall;
    for (int axis = 0; axis < 3; ++axis) {
      if (d[axis] == 0) continue;
      const double t = ((d[axis] > 0 ? size_[axis] : 0) - x[axis]) / d[axis];
      if (t >= nearest) continue;
      nearest = t;
      const double inward = d[axis] > 0 ? -1 : 1;
      wall = axis == 0 ? Vec3{inward, 0, 0} : axis == 1 ? Vec3{0, inward, 0} : Vec3{0, 0, inward};
    }
    x = x + d * nearest;
    n = wall;
  }

  Vec3 size_;
  double albedo_;
  std::vector<Vec3> units_;
  Mistakes mistakes_;
};

}  // namespace shelfbeam::test
