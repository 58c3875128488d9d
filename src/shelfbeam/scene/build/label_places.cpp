#include "shelfbeam/scene/build/label_places.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "shelfbeam/math/box_index.hpp"
#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/scene/expect_running.hpp"
#include "shelfbeam/scene/fixture/edge_place.hpp"
#include "shelfbeam/scene/fixture/turn.hpp"

namespace shelfbeam {

namespace {

// m
constexpr double label_reach = 0.5;   // in front of an edge or a fixture: pegs, cards on tables
constexpr double behind_edge = 0.1;   // labels on the wall of a tub
constexpr double beside_board = 0.1;  // in height
constexpr double wall_reach = 0.15;

/// A place and the label's distance from it, m.
struct NearPlace {
  LabelPlace place;
  double distance = 0;
};

/// A position or direction in the frame of a rectangle in plan.
struct InFrame {
  Vec3 position, normal;
};

InFrame in_frame(const Footing& footing, const Label& label) {
  const auto [x, y] =
      turned({label.position.x - footing.at[0], label.position.y - footing.at[1]}, -footing.rotation_deg);
  const auto [nx, ny] = turned({label.normal.x, label.normal.y}, -footing.rotation_deg);
  return {{x, y, label.position.z}, {nx, ny, label.normal.z}};
}

double outside(double value, double low, double high) {
  return std::max({low - value, value - high, 0.0});
}

/// A side as a label sees it: its distance in front of the side and along it, and the length of the side.
struct FromSide {
  double in_front = 0, along = 0, length = 0, facing = 0;
};

FromSide from_side(const Footing& footing, const InFrame& label, Face face) {
  const auto& [p, n] = label;
  switch (face) {
    case Face::front:
      return {-p.y, p.x, footing.length, -n.y};
    case Face::back:
      return {p.y - footing.depth, p.x, footing.length, n.y};
    case Face::left:
      return {-p.x, p.y, footing.depth, -n.x};
    case Face::right:
      return {p.x - footing.length, p.y, footing.depth, n.x};
  }
  return {};
}

constexpr double same_place = 1e-6;  // m
constexpr double facing_up = 0.7;    // of a normal: a label that faces up rather than outwards

std::optional<NearPlace> nearest_edge_place(const LabelEdges& edges, const Footing& footing,
                                            const Label& label) {
  const InFrame local = in_frame(footing, label);
  std::optional<NearPlace> best;
  for (const Face face : edges.faces) {
    const FromSide side = from_side(footing, local, face);
    const bool faces_up = local.normal.z > facing_up;
    if (side.in_front < -behind_edge || side.in_front > label_reach || (!faces_up && side.facing <= 0) ||
        outside(side.along, 0, side.length) > same_place)
      continue;
    for (std::size_t k = 0; k < edges.heights.size(); ++k) {
      const double off = std::abs(local.position.z - edges.heights[k]);
      const double distance = std::abs(side.in_front) + off;
      if (off > beside_board || (best && best->distance <= distance)) continue;
      best = NearPlace{{.face = face,
                        .on_top = faces_up && side.in_front < 0,
                        .board = static_cast<int>(k) + 1,
                        .along = std::clamp(side.along, 0.0, side.length)},
                       distance};
    }
  }
  return best;
}

std::optional<NearPlace> nearest_side(const Footing& footing, double bottom, double top, const Label& label) {
  const InFrame local = in_frame(footing, label);
  const Vec3& p = local.position;
  const double distance =
      std::hypot(outside(p.x, 0, footing.length), outside(p.y, 0, footing.depth), outside(p.z, bottom, top));
  if (distance > label_reach) return {};
  if (local.normal.z > facing_up) return NearPlace{{.on_top = true, .along = p.x}, distance};
  // The side that the label faces.
  std::optional<Face> face;
  double most = 0;
  for (const auto& [name, one] : names_of<Face>)
    if (const double facing = from_side(footing, local, one).facing; facing > most + same_place) {
      face = one;
      most = facing;
    }
  const double along = face ? from_side(footing, local, *face).along : 0;
  return NearPlace{{.face = face, .on_top = p.z > top, .along = along}, distance};
}

class PlaceFinder {
 public:
  PlaceFinder(const Store& store, const Scene& scene)
      : scene_(scene), index_(BoxIndex::over(scene.fixtures, [](const FixtureOutline& fixture) {
          Bounds box;
          for (const auto& [x, y] : fixture.footprint) {
            box.include(Vec3{x, y, 0});
            box.include(Vec3{x, y, fixture.height});
          }
          return box.wider_by(label_reach);
        })) {
    for (const auto& [fixture, where] : store.fixtures) fixtures_.emplace(id_of(fixture), &fixture);
    for (std::size_t f = 0; f < scene.fixtures.size(); ++f)
      outlines_.emplace(scene.fixtures[f].id, static_cast<std::uint32_t>(f));
    bottoms_.assign(scene.fixtures.size(), HUGE_VAL);
    for (const Part& part : scene.parts)
      bottoms_[part.fixture] = std::min(bottoms_[part.fixture], part.bottom);
  }

  LabelPlace find(const Label& label) const {
    // A fixture whose id begins the label's comes first: so the labels of fixtures have their ids.
    std::optional<NearPlace> best;
    std::uint32_t best_index = 0;
    const auto look = [&](std::uint32_t index) {
      auto near = place_at(index, label);
      if (!near) return false;
      const std::string& id = near->place.fixture = scene_.fixtures[index].id;
      if (label.id.starts_with(id + '-')) near->distance -= 2 * label_reach;
      if (!best || near->distance < best->distance ||
          (near->distance == best->distance && index < best_index)) {
        best = std::move(near);
        best_index = index;
      }
      return false;
    };
    const auto given = outlines_.find(label.place.fixture);
    if (given != outlines_.end())
      look(given->second);
    else
      index_.any({label.position, label.position}, look);
    if (best) return best->place;
    return label.place.is_known() ? label.place : wall_place(label);
  }

 private:
  std::optional<NearPlace> place_at(std::uint32_t index, const Label& label) const {
    const FixtureOutline& outline = scene_.fixtures[index];
    const double bottom = std::min(bottoms_[index], outline.height);
    const auto found = fixtures_.find(outline.id);
    if (found != fixtures_.end() && !outline.is_wall()) {
      const Fixture& fixture = *found->second;
      const auto footing = footing_of(fixture);
      if (const auto edges = label_edges(fixture); edges && footing)
        return nearest_edge_place(*edges, *footing, label);
      if (footing) return nearest_side(*footing, bottom, outline.height, label);
    }
    if (outline.footprint.size() < 2) return {};
    const Vec2 at{label.position.x, label.position.y};
    const double beside = contains(outline.footprint, at) ? 0 : distance_to_border(outline.footprint, at);
    const double distance = std::hypot(beside, outside(label.position.z, bottom, outline.height));
    if (distance > label_reach) return {};
    return NearPlace{{.on_top = label.normal.z > facing_up}, distance};
  }

  LabelPlace wall_place(const Label& label) const {
    if (!scene_.room) return {};
    const Polygon& outline = scene_.room->outline;
    const Vec2 at{label.position.x, label.position.y};
    if (distance_to_border(outline, at) > wall_reach) return {};
    const std::size_t number = nearest_edge(outline, at);
    const OuterWall wall = scene_.room->wall(number);
    return {.wall = number, .along = std::clamp(wall.along(at), 0.0, wall.length())};
  }

  const Scene& scene_;
  BoxIndex index_;
  std::unordered_map<std::string_view, const Fixture*> fixtures_;
  std::unordered_map<std::string_view, std::uint32_t> outlines_;
  std::vector<double> bottoms_;  // of the scene's fixtures, m
};

bool is_complete(const LabelPlace& place) {
  return place.board > 0 || place.face;
}

}  // namespace

void find_label_places(const Store& store, Scene& scene) {
  std::optional<PlaceFinder> finder;
  for (Label& label : scene.labels) {
    if (label.is_receiver || is_complete(label.place)) continue;
    expect_running(store.cancel);
    if (!finder) finder.emplace(store, scene);
    label.place = finder->find(label);
  }
}

}  // namespace shelfbeam
