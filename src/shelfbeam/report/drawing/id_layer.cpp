#include "shelfbeam/report/drawing/id_layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include <fmt/format.h>

#include "shelfbeam/math/compass.hpp"
#include "shelfbeam/math/distinct_positions.hpp"
#include "shelfbeam/report/drawing/fixture_look.hpp"

namespace shelfbeam {

namespace {

constexpr double smallest_id = 1;  // drawing units; the plan can be enlarged without limit

// Areas in the drawing that are taken, by the squares that they touch.
class TakenSpace {
 public:
  TakenSpace(const PlanView& view, const std::vector<Obstacle>& texts) : view_(view) {
    for (const Obstacle& text : texts) take(text);
  }

  bool is_free(const Rectangle& text) const {
    if (text.left < 0 || text.top < 0 || text.right > view_.width() || text.bottom > view_.height())
      return false;
    bool meets = false;
    each_square(text, [&](std::uint64_t square) {
      const auto found = taken_.find(square);
      if (found != taken_.end() && !meets)
        meets = std::any_of(found->second.begin(), found->second.end(),
                            [&](const Obstacle& o) { return o.meets(text); });
    });
    return !meets;
  }

  void take(const Obstacle& area) {
    each_square(area.bounds(), [&](std::uint64_t square) { taken_[square].push_back(area); });
  }
  void take(const Rectangle& area) { take(Obstacle(area)); }

 private:
  template <class Use>
  static void each_square(const Rectangle& area, Use use) {
    constexpr double side = 32;
    const auto index = [](double at) { return static_cast<std::int64_t>(std::floor(at / side)); };
    for (std::int64_t x = index(area.left); x <= index(area.right); ++x)
      for (std::int64_t y = index(area.top); y <= index(area.bottom); ++y)
        use((static_cast<std::uint64_t>(x) << 32U) ^ static_cast<std::uint32_t>(y));
  }

  const PlanView& view_;
  std::unordered_map<std::uint64_t, std::vector<Obstacle>> taken_;
};

Rectangle around(const Point& middle, double width, double height) {
  return {middle.x - width / 2, middle.y - height / 2, middle.x + width / 2, middle.y + height / 2};
}

void draw_id(SvgCanvas& canvas, const std::string& text, const Rectangle& place, double size,
             std::string_view css_class) {
  const Point middle = place.centre();
  canvas.raw(fmt::format("<g style=\"font-size:{}px\">", coordinate(size)));
  canvas.text({middle.x, middle.y + 0.35 * size}, text, css_class);
  canvas.raw("</g>");
}

// The id of the candidates at one point.
std::string shared_id(const std::vector<std::size_t>& members, const Scene& scene) {
  const std::string& first = scene.transceivers[members.front()].id;
  if (members.size() == 1) return first;
  const std::string_view axis = "/a";
  const auto stem = [&](std::size_t unit) {
    const std::string& id = scene.transceivers[unit].id;
    return id.substr(0, std::min(id.rfind(axis), id.size()));
  };
  const std::string common = stem(members.front());
  if (common != first &&
      std::all_of(members.begin(), members.end(), [&](std::size_t unit) { return stem(unit) == common; }))
    return fmt::format("{}-{}", first,
                       scene.transceivers[members.back()].id.substr(common.size() + axis.size()));
  return fmt::format("{} +{}", first, members.size() - 1);
}

// The middle of a run of edges.
Vec2 middle_of(const Polygon& polygon, const std::vector<std::size_t>& run) {
  const auto ends = [&](std::size_t edge) {
    return std::array{polygon[edge], polygon[(edge + 1) % polygon.size()]};
  };
  const auto extent = [&](std::size_t edge) {
    const auto [a, b] = ends(edge);
    return std::hypot(b[0] - a[0], b[1] - a[1]);
  };
  double left = 0;
  for (const std::size_t edge : run) left += extent(edge) / 2;
  for (const std::size_t edge : run) {
    const double own = extent(edge);
    if (left > own && edge != run.back()) {
      left -= own;
      continue;
    }
    const auto [a, b] = ends(edge);
    const double share = own > 0 ? left / own : 0;
    return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])};
  }
  return polygon[run.front()];
}

/// Columns reach above the heads, and stand on the floor.
bool has_named_faces(const FixtureOutline& fixture, Look look) {
  if (fixture.is_wall()) return true;
  return look == Look::solid && fixture.height > head_height &&
         (fixture.form == FixtureForm::block || fixture.form == FixtureForm::prism);
}

void draw_faces(SvgCanvas& canvas, const PlanView& view, const Scene& scene, TakenSpace& space) {
  const std::vector<Look> looks = looks_of(scene);
  for (std::size_t f = 0; f < scene.fixtures.size(); ++f) {
    const FixtureOutline& fixture = scene.fixtures[f];
    if (!has_named_faces(fixture, looks[f])) continue;
    for (const auto& [name, direction] : names_of<Compass>) {
      const std::string letter(1, static_cast<char>(name.front() - 'a' + 'A'));
      for (const auto& run : edges_towards(fixture.footprint, direction)) {
        const auto [x, y] = vector_of(direction);
        const Vec2 middle = middle_of(fixture.footprint, run);
        const Point at = view.at(middle[0], middle[1]);
        std::optional<Rectangle> place;
        double size = 11 * view.mark_share();
        for (; !place && size > smallest_id; size *= 0.8)
          for (const double gap : {2.0, 8.0}) {
            const double away = gap * view.mark_share() + size / 2;
            const Rectangle one = around({at.x + away * x, at.y - away * y}, text_width(letter, size), size);
            if (!place && space.is_free(one)) place = one;
          }
        if (!place) continue;
        space.take(*place);
        draw_id(canvas, letter, *place, place->bottom - place->top, "face");
      }
    }
  }
}

/// The candidates at each point of the plan, and the mark of the point.
struct CandidatePoint {
  std::vector<std::size_t> units;
  Point mark;
};

std::vector<CandidatePoint> candidate_points(const PlanView& view, const Scene& scene) {
  std::vector<Vec3> positions;
  for (const Transceiver& unit : scene.transceivers)
    positions.push_back({unit.position.x, unit.position.y, 0});
  const DistinctPositions groups = distinct_positions(positions);
  std::vector<CandidatePoint> points(groups.count);
  for (std::size_t j = 0; j < positions.size(); ++j) {
    points[groups.group_of[j]].units.push_back(j);
    points[groups.group_of[j]].mark = view.at(positions[j].x, positions[j].y);
  }
  return points;
}

double mark_arm(const PlanView& view) {
  return 4.5 * view.mark_share();
}

void draw_candidates(SvgCanvas& canvas, const PlanView& view, const Scene& scene,
                     const std::vector<CandidatePoint>& points, TakenSpace& space) {
  const double arm = mark_arm(view), largest = 10 * view.mark_share();
  for (const auto& [units, at] : points) {
    const std::string id = shared_id(units, scene);
    bool is_drawn = false;
    for (double size = largest; !is_drawn && size > smallest_id; size *= 0.85) {
      const double across = arm + text_width(id, size) / 2 + 0.2 * size, up = arm + 0.7 * size;
      const std::array<Point, 8> ways{{{across, 0},
                                       {-across, 0},
                                       {0, up},
                                       {0, -up},
                                       {across, up},
                                       {across, -up},
                                       {-across, up},
                                       {-across, -up}}};
      for (const Point& by : ways) {
        const Rectangle place = around({at.x + by.x, at.y + by.y}, text_width(id, size), size);
        if (is_drawn || !space.is_free(place)) continue;
        space.take(place);
        draw_id(canvas, id, place, size, "cid");
        is_drawn = true;
      }
    }
  }
}

}  // namespace

void draw_id_layer(SvgCanvas& canvas, const PlanView& view, const Scene& scene,
                   const std::vector<Obstacle>& texts) {
  TakenSpace space(view, texts);
  const std::vector<CandidatePoint> points = candidate_points(view, scene);
  for (const CandidatePoint& point : points)
    space.take(around(point.mark, 2 * mark_arm(view), 2 * mark_arm(view)));
  canvas.raw("<g id=\"ids\">\n");
  draw_faces(canvas, view, scene, space);
  draw_candidates(canvas, view, scene, points, space);
  canvas.raw("</g>\n");
}

}  // namespace shelfbeam
