#pragma once

#include <cstddef>
#include <vector>

#include "shelfbeam/math/frame.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// The candidate transceivers of a scene as light sources: frames made once.
class Emitters {
 public:
  explicit Emitters(const Scene& scene);

  std::size_t size() const { return units_.size(); }
  const Vec3& position(std::size_t j) const { return units_[j].position; }

  /// I_j(omega) / d^2 in W/m^2 at a point without regard to occlusion: the irradiance on a surface that faces
  /// the unit.
  double irradiance(std::size_t j, const Vec3& point) const;

 private:
  struct Unit {
    Vec3 position;
    Frame frame;
    const Emission* emission;
  };
  std::vector<Unit> units_;
};

}  // namespace shelfbeam
