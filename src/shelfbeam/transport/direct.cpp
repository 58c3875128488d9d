#include "shelfbeam/transport/direct.hpp"

namespace shelfbeam {

double direct_signal(const Label& label, const Responsivity& responsivity, const Emitters& emitters,
                     std::size_t j, const RayScene& rays) {
  const Vec3 to_unit = emitters.position(j) - label.position;
  const double distance = length(to_unit);
  if (distance == 0) return 0;
  const double r = response(responsivity, dot(to_unit, label.normal) / distance);
  if (r <= 0) return 0;
  const double signal = r * emitters.irradiance(j, label.position);
  return signal > 0 && !rays.occluded(label.position, label.normal, emitters.position(j)) ? signal : 0;
}

}  // namespace shelfbeam
