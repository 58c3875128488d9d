#include "shelfbeam/scene/build/misplaced.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/math/frame.hpp"
#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/scene/build/blocks.hpp"
#include "shelfbeam/scene/expect_running.hpp"
#include "shelfbeam/scene/label/label_name.hpp"
#include "shelfbeam/scene/plan_parts.hpp"

namespace shelfbeam {

namespace {

constexpr double rounding = Blocks::rounding, too_near = Blocks::too_near;

/// The corners of a label; empty for a point.
std::vector<Vec3> outline(const Scene& scene, const Label& label) {
  const auto& [width, height] = scene.type_of(label).size;
  if (width == 0) return {};
  const Frame frame = Frame::of_surface(label.normal);
  const Vec3 right = frame.x * (width / 2), up = frame.y * (height / 2);
  const Vec3& p = label.position;
  return {p - right - up, p + right - up, p + right + up, p - right + up};
}

/// Eight points on the edge of a transceiver's disc; empty for a point.
std::vector<Vec3> outline(const Scene& scene, const Transceiver& unit) {
  const double radius = scene.type_of(unit).radius;
  if (radius == 0) return {};
  const Frame frame = Frame::about(unit.axis);
  std::vector<Vec3> points(8);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double phi = static_cast<double>(k) * pi / 4;
    points[k] = unit.position + frame.to_world({radius * std::cos(phi), radius * std::sin(phi), 0});
  }
  return points;
}

/// The fixture that contains a part of the device.
template <class Device>
const std::string* around_a_part(const Scene& scene, const Blocks& blocks, const Device& device,
                                 const Vec3& normal) {
  for (const Vec3& p : outline(scene, device))
    if (const auto hit = blocks.next(p, normal); hit && hit->is_within()) return hit->fixture;
  return nullptr;
}

/// The surface of the room that the label faces closer than 5 cm, and its distance.
std::optional<std::pair<std::string, double>> room_surface_before(const Scene& scene, const Label& label) {
  if (!scene.room) return std::nullopt;
  auto surface = scene.room->surface_before(label.position, label.normal);
  if (!surface || surface->second >= too_near) return std::nullopt;
  return surface;
}

/// The corners of a label, or the points of a disc that are farthest towards the surfaces of the room.
std::vector<Vec3> rim(const Scene& scene, const Label& label) {
  return outline(scene, label);
}
std::vector<Vec3> rim(const Scene& scene, const Transceiver& unit) {
  const double radius = scene.type_of(unit).radius;
  if (radius == 0 || !scene.room) return {};
  std::vector<Vec3> points;
  const auto add = [&](const Vec3& direction) {
    const Vec3 along = direction - unit.axis * dot(direction, unit.axis);
    if (length(along) > rounding) points.push_back(unit.position + along * (radius / length(along)));
  };
  for (const double sign : {-1.0, 1.0})
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) add(axis * sign);
  const auto add_normal = [&](const Polygon& walls) {
    const std::size_t k = nearest_edge(walls, {unit.position.x, unit.position.y});
    const Vec2 &a = walls[k], &b = walls[(k + 1) % walls.size()];
    for (const double sign : {-1.0, 1.0}) add(Vec3{b[1] - a[1], a[0] - b[0], 0} * sign);
  };
  add_normal(scene.room->outline);
  for (const Polygon& hole : scene.room->holes) add_normal(hole);
  return points;
}

// For a device with its centre in the room.
template <class Device>
void warn_of_overhang(const Scene& scene, const std::string& place, const std::string& what,
                      const Device& device, WarningList& warnings) {
  for (const Vec3& p : rim(scene, device))
    if (const std::string side = beyond_room(scene, p); !side.empty()) {
      warnings.add(FindingCode::device_outside_room, place,
                   "{} extends {}, where no light arrives; move it inwards, or make it "
                   "smaller",
                   what, side);
      return;
    }
}

// Whether a part with all corners in the room extends across a hole or a corner of the outline, or through a
// ceiling.
bool crosses_border(const Scene& scene, const Part& part) {
  const RoomShape& room = *scene.room;
  if (room.is_box && room.zones.empty()) return false;
  const double top = part.top - rounding;
  if (part.kind != PartKind::mesh) return !is_within_room(room, part.footprint, top);
  // A concave prism; other meshes may surround a hole with their hull.
  if (scene.fixtures[part.fixture].form != FixtureForm::prism) return false;
  for (std::uint32_t t = part.first_triangle; t < part.first_triangle + part.triangle_count; ++t) {
    Polygon plan;
    for (const std::uint32_t v : scene.mesh.triangles[t])
      plan.push_back({scene.mesh.vertices[v].x, scene.mesh.vertices[v].y});
    if (!is_within_room(room, plan, top)) return true;
  }
  return false;
}

void warn_of_labels(const Scene& scene, const Blocks& blocks, const std::vector<std::string>& sources,
                    WarningList& warnings, const CancelToken* cancel) {
  for (std::size_t i = 0; i < scene.labels.size(); ++i) {
    expect_running(cancel);
    const Label& label = scene.labels[i];
    const std::string name = label_name(label.id, label.description);
    const auto looks_at = [&](const std::string& what, double distance) {
      warnings.add(FindingCode::label_faces_surface, sources[i],
                   "label {} faces {}, {:.2g} cm in front of it; reverse its normal, or move "
                   "it away from the surface",
                   name, what, 100 * std::max(0.0, distance));
    };
    const auto hit = blocks.next(label.position, label.normal);
    if (hit && hit->is_within())
      warnings.add(FindingCode::label_inside_fixture, sources[i],
                   "label {} is inside fixture {} and receives no light; "
                   "move one of them",
                   name, in_quotes(*hit->fixture));
    else if (hit)
      looks_at(fmt::format("fixture {}", in_quotes(*hit->fixture)), hit->distance);
    else if (const auto surface = room_surface_before(scene, label))
      looks_at(surface->first, surface->second);
    else if (const std::string* fixture = around_a_part(scene, blocks, label, label.normal))
      warnings.add(FindingCode::label_hidden, sources[i],
                   "part of label {} is inside fixture {} and receives no light; move it, turn it, "
                   "or change the 'size' of its type",
                   name, in_quotes(*fixture));
    else
      warn_of_overhang(scene, sources[i], fmt::format("label {}", name), label, warnings);
  }
}

bool is_within_bounds(const Scene& scene, const Vec3& p) {
  for (int axis = 0; axis < 3; ++axis)
    if (p[axis] < scene.lower[axis] - rounding || p[axis] > scene.upper[axis] + rounding) return false;
  return true;
}

void warn_of_transceivers(const Scene& scene, const Blocks& blocks, const std::vector<std::string>& sources,
                          WarningList& warnings, const CancelToken* cancel) {
  const Vec3 &low = scene.lower, &high = scene.upper;
  for (std::size_t j = 0; j < scene.transceivers.size(); ++j) {
    expect_running(cancel);
    const Transceiver& unit = scene.transceivers[j];
    const Vec3& p = unit.position;
    const auto hit = blocks.next(p, unit.axis);
    if (hit && hit->is_within())
      warnings.add(FindingCode::unit_inside_fixture, sources[j],
                   "transceiver {} is inside fixture {}, which blocks its light; move it, or "
                   "cover the position with 'keep_out'",
                   in_quotes(unit.id), in_quotes(*hit->fixture));
    else if (!scene.room && !is_within_bounds(scene, p))
      warnings.add(FindingCode::unit_outside, sources[j],
                   "transceiver {} at ({:.6g}, {:.6g}, {:.6g}) is outside all surfaces, which "
                   "extend from ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g}); move it, or give "
                   "the store a 'room'",
                   in_quotes(unit.id), p.x, p.y, p.z, low.x, low.y, low.z, high.x, high.y, high.z);
    else if (const std::string* fixture = around_a_part(scene, blocks, unit, unit.axis))
      warnings.add(FindingCode::unit_hidden, sources[j],
                   "part of transceiver {} is inside fixture {}, which blocks its light; move it, or "
                   "change the 'radius' of its type",
                   in_quotes(unit.id), in_quotes(*fixture));
    else
      warn_of_overhang(scene, sources[j], fmt::format("the disc of transceiver {}", in_quotes(unit.id)), unit,
                       warnings);
  }
}

}  // namespace

std::string beyond_room(const Scene& scene, const Vec3& p) {
  return scene.room ? scene.room->beyond(p, rounding) : std::string();
}

bool extends_outside_room(const Scene& scene, std::size_t first_vertex, std::size_t first_part) {
  if (!scene.room) return false;
  const auto vertices = scene.mesh.vertices.begin() + static_cast<std::ptrdiff_t>(first_vertex);
  const auto parts = scene.parts.begin() + static_cast<std::ptrdiff_t>(first_part);
  return std::any_of(vertices, scene.mesh.vertices.end(),
                     [&](const Vec3& p) { return !beyond_room(scene, p).empty(); }) ||
         std::any_of(parts, scene.parts.end(), [&](const Part& part) { return crosses_border(scene, part); });
}

std::string remedy_outside(const RoomShape& room, const std::vector<Vec3>& listed) {
  constexpr double nearly_all = 0.9, many = 0.3;
  constexpr std::size_t several = 3;
  const auto count_inside = [&](const auto& change) {
    return std::count_if(listed.begin(), listed.end(),
                         [&](const Vec3& p) { return room.beyond(change(p), 0).empty(); });
  };
  const auto inside = static_cast<double>(count_inside([](const Vec3& p) { return p; }));
  const bool is_of_list =
      listed.size() >= several && inside <= (1 - many) * static_cast<double>(listed.size());
  const auto helps = [&](const auto& change) {
    return is_of_list &&
           static_cast<double>(count_inside(change)) >= nearly_all * static_cast<double>(listed.size());
  };
  const auto exchange = [](const char* axes) {
    return fmt::format(
        "{} look exchanged: nearly all positions of the list would then be inside; exchange them", axes);
  };
  if (helps([](const Vec3& p) { return Vec3{p.y, p.x, p.z}; })) return exchange("x and y");
  if (helps([](const Vec3& p) { return Vec3{p.x, p.z, p.y}; })) return exchange("y and z");
  if (helps([](const Vec3& p) { return Vec3{p.z, p.y, p.x}; })) return exchange("x and z");
  for (const auto& [unit, metres] : {std::pair("feet", 0.3048), std::pair("inches", 0.0254),
                                     std::pair("centimetres", 0.01), std::pair("millimetres", 0.001)})
    if (helps([scale = metres](const Vec3& p) { return p * scale; }))
      return fmt::format(
          "the positions of the list look like {}: nearly all would then be inside; convert them, or give "
          "'units'",
          unit);
  return room.is_box ? "move it inside, or correct the room's size" : "move it inside, or correct the room";
}

void warn_of_misplaced(const Scene& scene, const DeviceSources& sources, WarningList& warnings,
                       const CancelToken* cancel) {
  const Blocks blocks(scene, Blocks::usual_visits(scene.labels.size() + scene.transceivers.size()));
  warn_of_labels(scene, blocks, sources.labels, warnings, cancel);
  warn_of_transceivers(scene, blocks, sources.transceivers, warnings, cancel);
  if (blocks.is_exhausted())
    warnings.add(FindingCode::place_unchecked, sources.fixtures.front(),
                 "too many fixtures lie at one place to check whether labels and units are "
                 "inside them; check their positions on the floor plan");
}

}  // namespace shelfbeam
