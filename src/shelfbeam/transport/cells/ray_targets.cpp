#include "shelfbeam/transport/cells/ray_targets.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "shelfbeam/math/frame.hpp"
#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/scene/wall_section.hpp"

namespace shelfbeam {

namespace {

constexpr double min_probability = 0.0003;  // of a cosine distributed ray
constexpr double surroundings = 0.4;        // m, of a unit

Vec3 along(const InnerWall& wall) {
  return Vec3{wall.to[0] - wall.from[0], wall.to[1] - wall.from[1], 0} / wall.length();
}

// `at` may be before or beyond the wall.
RayTargets::Rectangle rectangle_of(const InnerWall& wall, const WallOpening& opening) {
  const Vec3 way = along(wall);
  const double height = opening.top - opening.bottom;
  return {.corner = Vec3{wall.from[0], wall.from[1], opening.bottom} + opening.at * way,
          .along = opening.width * way,
          .up = {0, 0, height},
          .normal = {-way.y, way.x, 0},
          .area = opening.width * height};
}

// Gaps up to this width count as openings; ordinary rays find wider ones.
constexpr double widest_gap = 1;  // m

struct BuiltWall {
  const InnerWall* wall;
  Polygon footprint;

  // A point of the plan in the middle of the wall, or beyond its ends.
  Vec2 at(double distance) const {
    const Vec3 way = along(*wall);
    return {wall->from[0] + distance * way.x, wall->from[1] + distance * way.y};
  }
};

std::vector<BuiltWall> built_walls(const RoomShape& room) {
  std::vector<BuiltWall> walls;
  for (std::size_t w = 0; w < room.inner_walls.size(); ++w) {
    const InnerWall& wall = room.inner_walls[w];
    const auto [begin, end] = ends_of(room, w);
    walls.push_back({&wall, wall.footprint(begin, end)});
  }
  return walls;
}

double ceiling_at(const RoomShape& room, const Vec2& p) {
  return room.ceiling_over(p).at(p);
}

// The gap between the top of a wall and the ceiling, up to the widest where it is wider in places.
std::optional<WallOpening> gap_above(const RoomShape& room, const BuiltWall& built) {
  constexpr double step = 0.5;  // m
  if (!built.wall->height) return std::nullopt;
  const double length = built.wall->length();
  const int steps = std::max(1, static_cast<int>(std::ceil(length / step)));
  double widest = 0;
  bool any_narrow = false;
  for (int k = 0; k <= steps; ++k) {
    const double gap = ceiling_at(room, built.at(length * k / steps)) - *built.wall->height;
    any_narrow = any_narrow || (gap > 0 && gap <= widest_gap);
    widest = std::max(widest, gap);
  }
  if (!any_narrow) return std::nullopt;
  const double bottom = *built.wall->height;
  return WallOpening{
      .at = 0, .width = length, .bottom = bottom, .top = bottom + std::min(widest, widest_gap)};
}

// The gap between a free end of a wall and the next wall in line with it.
std::optional<WallOpening> gap_beside(const RoomShape& room, const std::vector<BuiltWall>& walls,
                                      const BuiltWall& built, bool is_end) {
  constexpr double step = 0.005;  // m
  const double length = built.wall->length();
  const auto beyond = [&](double distance) { return is_end ? length + distance : -distance; };
  const Vec2 end = built.at(beyond(0));
  std::vector<const Polygon*> near;
  const PlanBounds around{{end[0] - widest_gap, end[1] - widest_gap},
                          {end[0] + widest_gap, end[1] + widest_gap}};
  for (const BuiltWall& other : walls)
    if (bounds_of(other.footprint).meets(around)) near.push_back(&other.footprint);
  const auto is_free = [&](const Vec2& p) {
    return room.covers(p) &&
           std::none_of(near.begin(), near.end(), [&](const Polygon* other) { return contains(*other, p); });
  };
  double gap = 0;
  while (gap <= widest_gap && is_free(built.at(beyond(gap + step / 2)))) gap += step;
  if (gap == 0 || gap > widest_gap) return std::nullopt;
  const double top = built.wall->height.value_or(ceiling_at(room, built.at(beyond(gap / 2))));
  return WallOpening{.at = is_end ? length : -gap, .width = gap, .bottom = 0, .top = top};
}

// Squares of small sines would cancel.
double one_minus_cosine(const RayTargets::Ball& ball, double distance_squared) {
  const double squared = std::min(1.0, ball.radius * ball.radius / distance_squared);
  return squared / (1 + std::sqrt(1 - squared));
}

struct Probability {
  const Vec3 &position, &normal;

  // Roughly, from the centre, and from the part that lies farthest before the surface.
  double operator()(const RayTargets::Rectangle& target) const {
    const Vec3 way = target.corner + 0.5 * (target.along + target.up) - position;
    const double ahead =
        dot(way, normal) + 0.5 * (std::abs(dot(target.along, normal)) + std::abs(dot(target.up, normal)));
    const double squared = length_squared(way);
    return squared > 0 ? target.area * std::abs(dot(way, target.normal)) * ahead / (pi * squared * squared)
                       : 0;
  }
  double operator()(const RayTargets::Ball& target) const {
    const Vec3 way = target.center - position;
    const double squared = length_squared(way), radius = target.radius;
    if (!(squared > radius * radius)) return 0;  // most rays meet it
    return radius * radius * (dot(way, normal) + radius) / (squared * std::sqrt(squared));
  }
};

struct Direction {
  const Vec3& from;
  double u1, u2;

  Vec3 operator()(const RayTargets::Rectangle& target) const {
    return normalized(target.corner + u1 * target.along + u2 * target.up - from);
  }
  Vec3 operator()(const RayTargets::Ball& target) const {
    const Vec3 way = target.center - from;
    const double cosine = 1 - u1 * one_minus_cosine(target, length_squared(way));
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    return Frame::about(normalized(way))
        .to_world({sine * std::cos(2 * pi * u2), sine * std::sin(2 * pi * u2), cosine});
  }
};

struct Density {
  const Vec3 &from, &direction;

  double operator()(const RayTargets::Rectangle& target) const {
    const double cosine = dot(direction, target.normal);
    if (cosine == 0) return 0;
    const double distance = dot(target.corner - from, target.normal) / cosine;
    if (!(distance > 0)) return 0;
    const Vec3 within = from + distance * direction - target.corner;
    const double x = dot(within, target.along), y = dot(within, target.up);
    if (x < 0 || y < 0 || x > length_squared(target.along) || y > length_squared(target.up)) return 0;
    return distance * distance / (target.area * std::abs(cosine));
  }
  double operator()(const RayTargets::Ball& target) const {
    const Vec3 way = target.center - from;
    const double squared = length_squared(way), part = one_minus_cosine(target, squared);
    return dot(direction, way) >= (1 - part) * std::sqrt(squared) ? 1 / (2 * pi * part) : 0;
  }
};

}  // namespace

RayTargets::RayTargets(const Scene& scene) {
  if (!scene.room) return;
  const RoomShape& room = *scene.room;
  const std::vector<BuiltWall> walls = built_walls(room);
  for (const BuiltWall& built : walls) {
    std::vector<WallOpening> openings = built.wall->openings;
    for (const auto& gap : {gap_above(room, built), gap_beside(room, walls, built, false),
                            gap_beside(room, walls, built, true)})
      if (gap) openings.push_back(*gap);
    for (const WallOpening& opening : openings)
      if (opening.width > 0 && opening.top > opening.bottom)
        add_rectangle(rectangle_of(*built.wall, opening));
  }
}

// A gap between the ends of two walls in line belongs to both.
void RayTargets::add_rectangle(const Rectangle& rectangle) {
  constexpr double same = 0.01;  // m
  const auto is_same = [&](const Target& target) {
    const auto* const known = std::get_if<Rectangle>(&target);
    if (known == nullptr || std::abs(dot(known->normal, rectangle.normal)) < 0.9) return false;
    const Vec3 apart = known->corner - rectangle.corner + 0.5 * (known->along + known->up) -
                       0.5 * (rectangle.along + rectangle.up);
    return length(apart) < same;
  };
  if (std::none_of(targets_.begin(), targets_.end(), is_same)) targets_.push_back(rectangle);
}

void RayTargets::add_unit(const Vec3& position) {
  targets_.push_back(Ball{position, surroundings});
}

bool RayTargets::is_close(const Vec3& position) const {
  return std::any_of(targets_.begin(), targets_.end(), [&](const Target& target) {
    const auto* const ball = std::get_if<Ball>(&target);
    return ball != nullptr && length_squared(position - ball->center) < ball->radius * ball->radius;
  });
}

RayTargets::View RayTargets::seen_from(const Vec3& position, const Vec3& normal, std::uint32_t own) const {
  std::array<std::pair<double, const Target*>, View::most> seen{};
  for (const Target& target : targets_) {
    std::pair next{std::visit(Probability{position, normal}, target), &target};
    if (!(next.first >= min_probability)) continue;
    for (auto& kept : seen)
      if (next.first > kept.first) std::swap(kept, next);
  }
  View view;
  view.rays_ = std::max(1U, own / 8);
  for (const auto& [probability, target] : seen)
    if (target != nullptr) view.targets_[view.count_++] = target;
  return view;
}

Vec3 RayTargets::View::direction(std::size_t target, const Vec3& from, double u1, double u2) const {
  return std::visit(Direction{from, u1, u2}, *targets_[target]);
}

double RayTargets::View::density(const Vec3& from, const Vec3& direction) const {
  double sum = 0;
  for (std::size_t k = 0; k < count_; ++k) sum += std::visit(Density{from, direction}, *targets_[k]);
  return rays_ * sum;
}

}  // namespace shelfbeam
