#include "shelfbeam/transport/world/glass_devices.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <variant>

#include "shelfbeam/math/box_index.hpp"

namespace shelfbeam {

namespace {

class Glass {
 public:
  Glass(const Scene& scene, double distance, double overlap) : distance_(distance), overlap_(overlap) {
    const TriangleMesh& mesh = scene.mesh;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Material& material = scene.materials[mesh.materials[t].value].material;
      const bool is_solid = shelfbeam::is_solid(material);
      if (!is_solid && !is_pane(material)) continue;
      Face& face = faces_.emplace_back(Face{{}, is_solid});
      for (std::size_t k = 0; k < 3; ++k) face.corners[k] = mesh.vertices[mesh.triangles[t][k]];
    }
    std::vector<Bounds> boxes(faces_.size());
    for (std::size_t t = 0; t < boxes.size(); ++t)
      for (const Vec3& corner : faces_[t].corners) boxes[t].include(corner);
    index_ = BoxIndex(std::move(boxes));
  }

  bool is_empty() const { return faces_.empty(); }

  /// Moves a position off the glass near it. Returns whether there is any.
  bool clear(Vec3& position, const Vec3& axis) const {
    bool is_moved = false;
    index_.any(Bounds{position, position}.wider_by(distance_), [&](std::uint32_t t) {
      is_moved = clear(faces_[t], position, axis) || is_moved;
      return false;
    });
    return is_moved;
  }

 private:
  struct Face {
    std::array<Vec3, 3> corners;
    bool is_solid;  ///< the glass lies behind it
  };

  bool clear(const Face& face, Vec3& position, const Vec3& axis) const {
    const auto& [a, b, c] = face.corners;
    const Vec3 whole = cross(b - a, c - a), p = position - a;
    const double u = dot(cross(p, c - a), whole), v = dot(cross(b - a, p), whole);
    constexpr double rounding = 1e-9;
    const double area = length_squared(whole), slack = rounding * area;
    if (!(area > 0) || u < -slack || v < -slack || u + v > area + slack) return false;
    Vec3 ahead = whole / std::sqrt(area);
    const double facing = dot(ahead, axis);
    if (!face.is_solid && facing < 0) ahead = -ahead;
    const double beyond = face.is_solid || std::abs(facing) > rounding ? overlap_ : 0, height = dot(p, ahead);
    if (!(std::abs(height) < distance_) || (face.is_solid && height < -beyond)) return false;
    position = position + ahead * ((height < -beyond ? -distance_ : distance_) - height);
    return true;
  }

  double distance_, overlap_;
  std::vector<Face> faces_;
  BoxIndex index_{{}};
};

}  // namespace

std::optional<Devices> devices_off_glass(const Scene& scene, Devices devices, double distance,
                                         double overlap) {
  const Glass glass(scene, distance, overlap);
  if (glass.is_empty()) return std::nullopt;
  bool is_moved = false;
  for (Label& label : devices.labels) is_moved = glass.clear(label.position, label.normal) || is_moved;
  for (Transceiver& unit : devices.transceivers) is_moved = glass.clear(unit.position, unit.axis) || is_moved;
  return is_moved ? std::optional(std::move(devices)) : std::nullopt;
}

}  // namespace shelfbeam
