#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "shelfbeam/math/random.hpp"
#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// Places through which or from which much light may come, although few random rays of a point meet them:
/// openings of inner walls and gaps of up to a metre above them or beside their free ends, in line with the
/// wall, because the room behind may be far brighter, and the surroundings of units that are mounted close to
/// a surface.
class RayTargets {
 public:
  /// An opening or a gap, in the middle of its wall.
  struct Rectangle {
    Vec3 corner, along, up;  ///< edges from the corner, m
    Vec3 normal;             ///< unit length
    double area = 0;         ///< m^2
  };
  struct Ball {
    Vec3 center;
    double radius = 0;  ///< m
  };
  using Target = std::variant<Rectangle, Ball>;

  /// The openings and gaps of a scene, none without a room.
  explicit RayTargets(const Scene& scene);
  /// The surroundings of a unit.
  void add_unit(const Vec3& position);

  /// Whether a point is in the surroundings of a unit.
  bool is_close(const Vec3& position) const;

  class View;
  /// For a point from which `own` rays start: the targets before a surface that a cosine distributed ray
  /// meets with a probability of about 0.0003 or more, up to View::most.
  View seen_from(const Vec3& position, const Vec3& normal, std::uint32_t own) const;

 private:
  void add_rectangle(const Rectangle& rectangle);

  std::vector<Target> targets_;
};

/// Targets in view of a point, for multiple importance sampling of directions: to each target goes one ray
/// for eight of the point's own, at least one, and the balance heuristic weights them all.
class RayTargets::View {
 public:
  static constexpr std::size_t most = 4;

  bool is_empty() const { return count_ == 0; }
  /// The number of rays to targets, times their density per solid angle in a direction.
  double density(const Vec3& from, const Vec3& direction) const;
  /// The weight of an own ray: `own` is the number of these, times their density in its direction. 1 for a
  /// ray along the surface, whose density is 0.
  double weight(double own, const Vec3& from, const Vec3& direction) const {
    return is_empty() || !(own > 0) ? 1 : own / (own + density(from, direction));
  }

  /// Calls look(target, u1, u2) for each ray to a target; `direction` maps these numbers.
  template <class Look>
  void each_ray(std::uint64_t key, const Look& look) const {
    for (std::size_t k = 0; k < count_; ++k) {
      const ScrambledSobol square(mix_key(key, 0x7A26E7 + k));
      for (std::uint32_t t = 0; t < rays_; ++t) {
        const auto [u1, u2] = square.point(t);
        look(k, u1, u2);
      }
    }
  }
  Vec3 direction(std::size_t target, const Vec3& from, double u1, double u2) const;

 private:
  friend class RayTargets;
  std::array<const Target*, most> targets_{};
  std::size_t count_ = 0;
  std::uint32_t rays_ = 0;  ///< to each target
};

}  // namespace shelfbeam
