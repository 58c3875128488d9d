#include "shelfbeam/transport/emitters.hpp"

#include "shelfbeam/math/warp.hpp"

namespace shelfbeam {

Emitters::Emitters(const Scene& scene) {
  units_.reserve(scene.transceivers.size());
  for (const Transceiver& unit : scene.transceivers)
    units_.push_back(
        {unit.position, Frame::of_device(unit.axis, radians(unit.roll_deg)), &scene.type_of(unit).emission});
}

double Emitters::irradiance(std::size_t j, const Vec3& point) const {
  const Unit& unit = units_[j];
  const Vec3 d = point - unit.position;
  const double squared = length_squared(d);
  if (squared == 0) return 0;
  return intensity(*unit.emission, unit.frame.to_local(d / std::sqrt(squared))) / squared;
}

}  // namespace shelfbeam
