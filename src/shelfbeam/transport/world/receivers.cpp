#include "shelfbeam/transport/world/receivers.hpp"

namespace shelfbeam {

Receivers::Receivers(const Scene& scene) {
  labels_.reserve(scene.labels.size());
  for (const Label& label : scene.labels) {
    const LabelType& type = scene.type_of(label);
    if (type.size[0] > 0) rectangles_.push_back(static_cast<std::uint32_t>(labels_.size()));
    labels_.push_back(
        {label.position, Frame::of_surface(label.normal), type.size[0], type.size[1], &type.responsivity});
  }
}

SurfacePoint Receivers::point(std::size_t i, double u1, double u2) const {
  const Sensor& label = labels_[i];
  if (label.width == 0) return {label.position, label.frame.z};
  return {label.position + label.frame.to_world({(u1 - 0.5) * label.width, (u2 - 0.5) * label.height, 0}),
          label.frame.z};
}

}  // namespace shelfbeam
