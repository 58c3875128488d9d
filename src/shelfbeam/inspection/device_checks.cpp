#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/inspection/checks.hpp"
#include "shelfbeam/material/material.hpp"
#include "shelfbeam/math/box_index.hpp"
#include "shelfbeam/math/frame.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/scene/label/label_name.hpp"

namespace shelfbeam {

namespace {

// A check visits at most this many devices around a place, because there may be thousands at one place. All
// checks of a shop with a few devices at each place visit no more.
constexpr std::size_t most_neighbours = 1000;

// An earlier device for which `is_same` holds, at most `distance` away along each axis.
template <class Devices, class Same>
std::optional<std::size_t> earlier(const Devices& devices, const BoxIndex& index, std::size_t i,
                                   double distance, const Same& is_same) {
  std::optional<std::size_t> found;
  std::size_t visited = 0;
  const Vec3& p = devices[i].position;
  index.any(Bounds{p, p}.wider_by(distance), [&](std::uint32_t k) {
    if (k < i && is_same(devices[k])) found = k;
    return found.has_value() || ++visited == most_neighbours;
  });
  return found;
}

struct Distance {
  double metres;
  const NamedMaterial* material;
  bool is_mesh;
};

// The first opaque surface along a direction, up to `limit`.
std::optional<Distance> opaque_before(const Inspected& store, const SurfacePoint& from, const Vec3& direction,
                                      double limit) {
  const auto hit = store.rays.intersect(from, direction);
  if (!hit) return std::nullopt;
  const double distance = length(hit->point.position - from.position);
  const NamedMaterial& named = store.scene.materials[hit->material.value];
  if (distance > limit || !is_opaque(named.material)) return std::nullopt;
  return Distance{distance, &named, store.is_mesh[hit->point.triangle]};
}

// The distance to the first surface along a direction from a point slightly in front of a label, or infinity.
double surface_beside(const Inspected& store, const Label& label, const Vec3& direction) {
  constexpr double in_front = 0.005;
  const SurfacePoint from{label.position + label.normal * in_front, label.normal};
  const auto hit = store.rays.intersect(from, direction);
  return hit ? length(hit->point.position - from.position) - in_front : HUGE_VAL;
}

// Eight directions at this angle from the rear of a label.
std::array<Vec3, 8> directions_behind(const Label& label, double angle) {
  const Frame frame = Frame::of_surface(label.normal);
  std::array<Vec3, 8> directions;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const double phi = static_cast<double>(k) * pi / 4;
    directions[k] =
        frame.to_world({std::sin(angle) * std::cos(phi), std::sin(angle) * std::sin(phi), -std::cos(angle)});
  }
  return directions;
}

// Whether a label is mounted on something: a surface behind it or, on rails and pegs, beside it.
bool has_support(const Inspected& store, const Label& label) {
  constexpr double farthest = 0.3;
  if (surface_beside(store, label, -label.normal) <= farthest) return true;
  for (const double angle : {30.0, 60.0, 85.0})
    for (const Vec3& direction : directions_behind(label, radians(angle)))
      if (surface_beside(store, label, direction) <= farthest) return true;
  return false;
}

// Whether the normal of a label points along the surface on which it is mounted.
bool is_turned_sideways(const Inspected& store, const Label& label) {
  constexpr double mounted = 0.02, clear = 0.1;
  if (surface_beside(store, label, -label.normal) <= clear) return false;
  for (const Vec3& direction : directions_behind(label, pi / 2))
    if (surface_beside(store, label, direction) <= mounted) return true;
  return false;
}

class LabelChecks {
 public:
  LabelChecks(const Inspected& store, WarningList& warnings)
      : store_(store),
        labels_(store.scene.labels),
        warnings_(warnings),
        index_(index_of_positions(labels_)) {}

  void check() {
    for (const std::uint32_t i : store_.labels) {
      if (labels_[i].is_receiver) continue;
      store_.expect_running();
      check_neighbours(i);
      check_direction(i);
      if (store_.blocks.contain(labels_[i].position)) continue;  // make_scene warns of it
      if (is_turned_sideways(store_, labels_[i]))
        warn(FindingCode::label_sideways, i,
             "is turned along the surface beside it, which is not behind it; a label usually faces away "
             "from its shelf or wall; turn its normal");
      else if (!has_support(store_, labels_[i]) && !has_back_to_back(i))
        warn(FindingCode::label_in_mid_air, i,
             "has no surface within 0.3 m behind it; a label is typically mounted on a shelf, a wall or a "
             "rail; correct its position or its normal");
      check_free_space(i);
    }
  }

 private:
  void warn(FindingCode code, std::size_t i, std::string_view problem) {
    const Vec3& p = labels_[i].position;
    const std::string text =
        fmt::format("label {} at ({:.6g}, {:.6g}, {:.6g}) {}",
                    label_name(labels_[i].id, labels_[i].description), p.x, p.y, p.z, problem);
    warnings_.add_text(code, store_.sources.labels[i], text, {labels_[i].id, p.x, p.y, p.z});
  }

  // The other label of a sign with a label on either side.
  bool has_back_to_back(std::size_t i) const {
    constexpr double thickest = 0.1;
    std::size_t visited = 0;
    const Vec3& p = labels_[i].position;
    return index_.any(Bounds{p, p}.wider_by(thickest), [&](std::uint32_t k) {
      return dot(labels_[k].normal, labels_[i].normal) < -0.5 || ++visited == most_neighbours;
    });
  }

  void check_neighbours(std::size_t i) {
    constexpr double nearest = 0.015;  // half the width of the smallest labels
    const auto faces_alike = [&](const Label& other) { return dot(other.normal, labels_[i].normal) > 0.5; };
    if (const auto other = earlier(labels_, index_, i, nearest, faces_alike))
      warn(FindingCode::label_twice, i,
           fmt::format("is {:.2g} mm from label {}; labels are typically at least 3 cm apart; remove one of "
                       "them, or correct its position",
                       1000 * length(labels_[*other].position - labels_[i].position),
                       label_name(labels_[*other].id, labels_[*other].description)));
  }

  void check_direction(std::size_t i) {
    constexpr double lowest = 0.03, highest = 6, below_ceiling = 0.25, standing = 2.3;
    const Label& label = labels_[i];
    const double height = label.position.z - store_.floor();
    const auto& room = store_.scene.room;
    const Vec2 plan{label.position.x, label.position.y};
    const double ceiling = room ? room->ceiling_over(plan).at(plan) : store_.scene.upper.z;
    const bool is_at_ceiling = height > standing && label.position.z > ceiling - below_ceiling;
    if (is_at_ceiling || height > highest || (height < lowest && std::abs(label.normal.z) < 0.5))
      warn(FindingCode::label_height, i,
           fmt::format("is {:.3g} m above the floor; 0.1 to 2.2 m are typical; correct its height", height));
    if (label.normal.z < -0.8)
      warn(FindingCode::label_faces_floor, i,
           "faces the floor; a label usually faces the aisle; correct its normal, or 'tilt_deg' of its "
           "fixture");
  }

  // make_scene warns of blocks and of the room right in front of labels.
  void check_free_space(std::size_t i) {
    constexpr double narrowest = 0.35;
    const Label& label = labels_[i];
    const SurfacePoint from{label.position, label.normal};
    if (const auto before = opaque_before(store_, from, label.normal, Blocks::too_near)) {
      if (before->is_mesh)
        warn(FindingCode::label_faces_surface, i,
             fmt::format(
                 "faces a surface of '{}', {:.2g} cm in front of it; reverse its normal, or move it away "
                 "from the surface",
                 before->material->name, 100 * before->metres));
      return;
    }
    if (std::abs(label.normal.z) > 0.8) return;
    const Vec3 ahead = normalized({label.normal.x, label.normal.y, 0});
    if (const auto before = opaque_before(store_, from, ahead, narrowest))
      warn(FindingCode::label_without_aisle, i,
           fmt::format(
               "has {:.2g} cm of free space in front of it, up to a surface of '{}'; aisles of 0.9 m and "
               "more are typical; move one of the fixtures",
               100 * before->metres, before->material->name));
  }

  const Inspected& store_;
  const std::vector<Label>& labels_;
  WarningList& warnings_;
  BoxIndex index_;
};

class UnitChecks {
 public:
  UnitChecks(const Inspected& store, WarningList& warnings)
      : store_(store),
        units_(store.scene.transceivers),
        warnings_(warnings),
        index_(index_of_positions(units_)) {}

  void check() {
    for (std::size_t j = 0; j < units_.size(); ++j) {
      store_.expect_running();
      check_twins(j);
      if (store_.blocks.contain(units_[j].position)) continue;  // make_scene warns of it
      check_axis(j);
      check_height(j);
    }
  }

 private:
  void warn(FindingCode code, std::size_t j, std::string_view problem) {
    const Vec3& p = units_[j].position;
    const std::string text =
        fmt::format("transceiver '{}' at ({:.6g}, {:.6g}, {:.6g}) {}", units_[j].id, p.x, p.y, p.z, problem);
    warnings_.add_text(code, store_.sources.transceivers[j], text, {units_[j].id, p.x, p.y, p.z});
  }

  void check_twins(std::size_t j) {
    constexpr double same_place = 0.01;
    const Transceiver& unit = units_[j];
    const auto is_twin = [&](const Transceiver& other) {
      return other.type == unit.type && dot(other.axis, unit.axis) > 0.9999 &&
             std::abs(other.roll_deg - unit.roll_deg) < 0.1;
    };
    if (const auto other = earlier(units_, index_, j, same_place, is_twin))
      warn(FindingCode::unit_twice, j,
           fmt::format("has the place, type, axis and roll of '{}'; usually each candidate is listed once; "
                       "remove one of them, or correct its position",
                       units_[*other].id));
  }

  void check_axis(std::size_t j) {
    constexpr double nearest = 0.3, below_ceiling = 2;
    const Transceiver& unit = units_[j];
    const SurfacePoint from{unit.position, unit.axis};
    const bool is_up = unit.axis.z > 0.5;
    const auto before = opaque_before(store_, from, unit.axis, is_up ? below_ceiling : nearest);
    if (before && before->metres <= nearest)
      warn(FindingCode::unit_faces_surface, j,
           fmt::format("is aimed at a surface of '{}', {:.2g} cm in front of it; units are typically aimed "
                       "at the shelves; correct 'axis' or the position",
                       before->material->name, 100 * before->metres));
    else if (before)
      warn(FindingCode::unit_faces_ceiling, j,
           "is aimed up at the ceiling; units are typically aimed at the shelves; correct 'axis', which is "
           "[0, 0, -1] for straight down");
  }

  // Units that are aimed down belong on a ceiling.
  void check_height(std::size_t j) {
    constexpr double lowest = 1.5;
    const double height = units_[j].position.z - store_.floor();
    if (units_[j].axis.z < -0.5 && height < lowest)
      warn(FindingCode::unit_height, j,
           fmt::format(
               "is aimed down from {:.3g} m above the floor; 2.2 m and more are typical; correct its height",
               height));
  }

  const Inspected& store_;
  const std::vector<Transceiver>& units_;
  WarningList& warnings_;
  BoxIndex index_;
};

}  // namespace

void warn_of_labels(const Inspected& store, WarningList& warnings) {
  LabelChecks(store, warnings).check();
}

void warn_of_units(const Inspected& store, WarningList& warnings) {
  UnitChecks(store, warnings).check();
}

}  // namespace shelfbeam
