#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/math/frame.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/transport/world/ray_scene.hpp"

namespace shelfbeam {

/// The labels of a scene as sensors, one row of the signal matrix each: points, and rectangles over which the
/// signal is averaged. The width of a rectangle is horizontal.
class Receivers {
 public:
  explicit Receivers(const Scene& scene) {
    labels_.reserve(scene.labels.size());
    for (const Label& label : scene.labels) {
      const LabelType& type = scene.type_of(label);
      if (type.size[0] > 0) rectangles_.push_back(static_cast<std::uint32_t>(labels_.size()));
      labels_.push_back(
          {label.position, Frame::of_surface(label.normal), type.size[0], type.size[1], &type.responsivity});
    }
  }

  std::size_t size() const { return labels_.size(); }
  bool is_point(std::size_t i) const { return labels_[i].width == 0; }

  /// Samples a point of the label uniformly over its area, from two uniform random numbers.
  SurfacePoint point(std::size_t i, double u1, double u2) const {
    const Sensor& label = labels_[i];
    if (label.width == 0) return {label.position, label.frame.z};
    return {label.position + label.frame.to_world({(u1 - 0.5) * label.width, (u2 - 0.5) * label.height, 0}),
            label.frame.z};
  }

  /// z is the label's normal.
  const Frame& frame(std::size_t i) const { return labels_[i].frame; }
  const Responsivity& responsivity(std::size_t i) const { return *labels_[i].responsivity; }

  /// R towards a unit-length direction.
  double response(std::size_t i, const Vec3& direction) const {
    return shelfbeam::response(*labels_[i].responsivity, dot(direction, labels_[i].frame.z));
  }

  /// Calls use(i, signal per watt) for every rectangle that a ray crosses between the distances `nearest` and
  /// `farthest`: a watt along the ray gives the signal R / (A cos), averaged over the area A.
  template <class Use>
  void each_rectangle(const RayScene& rays, const Vec3& origin, const Vec3& direction, double nearest,
                      double farthest, Use use) const {
    for (const std::uint32_t i : rectangles_) {
      const Sensor& label = labels_[i];
      const double cosine = -dot(direction, label.frame.z);
      if (cosine <= 0) continue;
      const double distance = dot(origin - label.position, label.frame.z) / cosine;
      if (!rays.is_between(distance, nearest, farthest)) continue;
      const Vec3 d = origin + direction * distance - label.position;
      if (std::abs(dot(d, label.frame.x)) > label.width / 2 ||
          std::abs(dot(d, label.frame.y)) > label.height / 2)
        continue;
      use(i, shelfbeam::response(*label.responsivity, cosine) / (cosine * label.width * label.height));
    }
  }

 private:
  struct Sensor {
    Vec3 position;
    Frame frame;
    double width, height;
    const Responsivity* responsivity;
  };
  std::vector<Sensor> labels_;
  std::vector<std::uint32_t> rectangles_;
};

}  // namespace shelfbeam
