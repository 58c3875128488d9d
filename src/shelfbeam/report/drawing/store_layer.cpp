#include "shelfbeam/report/drawing/store_layer.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "shelfbeam/math/distinct_positions.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/drawing/fixture_look.hpp"
#include "shelfbeam/report/drawing/part_drawing.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

std::string fixture_class(const FixtureOutline& fixture) {
  switch (fixture.form) {
    case FixtureForm::rack:
      return "fx fx-g";
    case FixtureForm::chest:
      return "fx fx-f";
    case FixtureForm::mesh:
      return "fx fx-m";
    case FixtureForm::sheet:
      return "fx fx-b fx-m";
    case FixtureForm::block:
    case FixtureForm::prism:
    case FixtureForm::wall:
      break;
  }
  return "fx fx-b";
}

}  // namespace

std::string fixture_title(const Words& words, const FixtureOutline& fixture) {
  return words.say("drawing.fixture", fixture.id, words(fmt::format("drawing.types.{}", fixture.type)),
                   words.fixed(fixture.height, 2));
}

void draw_outline(SvgCanvas& canvas, const PlanView& view, const FixtureOutline& fixture,
                  std::string_view css_class, const std::string& title) {
  const std::vector<Point> outline = view.outline(fixture.footprint);
  canvas.path(path_through(outline, outline.size() == 2), css_class, title);
}

void draw_fixtures(SvgCanvas& canvas, const PlanView& view, const Scene& scene) {
  const Words words = words_of(scene);
  const std::vector<Look> looks = looks_of(scene);
  for (const std::uint32_t f : fixtures_by_height(scene)) {
    const FixtureOutline& fixture = scene.fixtures[f];
    const std::string title = fixture_title(words, fixture);
    if (looks[f] == Look::overhead) {
      draw_outline(canvas, view, fixture, "fx-o", title);
      continue;
    }
    const bool covers = looks[f] == Look::covering;
    const std::string section = mesh_section(view, scene, f);
    const std::string silhouette =
        covers || fixture.form == FixtureForm::prism ? std::string() : mesh_silhouette(view, scene, f);
    if (!silhouette.empty())
      canvas.path(silhouette, fixture_class(fixture), title);
    else if (section.empty())
      canvas.polygon(view.outline(fixture.footprint), fixture_class(fixture) + (covers ? " fx-c" : ""),
                     title);
    if (!section.empty()) canvas.path(section, "fx-s", title);
  }
  draw_inner_walls(canvas, view, scene);
}

void draw_free_points(SvgCanvas& canvas, const PlanView& view, std::span<const Vec3> candidates,
                      const std::vector<bool>& taken) {
  const DistinctPositions groups = distinct_positions(candidates);
  std::vector<bool> done(groups.count, false);
  for (std::size_t j = 0; j < candidates.size(); ++j)
    if (taken[j]) done[groups.group_of[j]] = true;

  const double arm = 4 * view.mark_share();
  const std::string d = coordinate(arm), d2 = coordinate(2 * arm);
  std::string data;
  for (std::size_t j = 0; j < candidates.size(); ++j) {
    if (done[groups.group_of[j]]) continue;
    done[groups.group_of[j]] = true;
    const Point p = view.at(candidates[j].x, candidates[j].y);
    data += fmt::format("M{} {}h{}m-{} -{}v{}", coordinate(p.x - arm), coordinate(p.y), d2, d, d, d2);
  }
  if (!data.empty()) canvas.path(data, "cand");
}

std::string aim_line(const Point& at, const Vec3& axis) {
  constexpr double longest = 20, min_sine = 0.05;  // drawing units; sine of the tilt
  if (std::hypot(axis.x, axis.y) < min_sine) return {};
  return fmt::format("M{} {}l{} {}", coordinate(at.x), coordinate(at.y), coordinate(longest * axis.x),
                     coordinate(-longest * axis.y));
}

double label_mark_radius(const PlanView& view, std::span<const Vec3> positions) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < positions.size(); ++k) {
    const Vec3 step = positions[k] - positions[k - 1];
    if (std::abs(step.z) < 1e-6 && length(step) > 1e-6) steps.push_back(length(step));
  }
  double usual = 0.5;
  if (!steps.empty()) {
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    usual = *middle;
  }
  return std::clamp(0.4 * usual * view.scale(), 2.0, 6.0);
}

std::vector<Point> label_mark_positions(const PlanView& view, std::span<const Vec3> positions,
                                        std::span<const Vec3> normals, double radius) {
  std::map<std::tuple<long, long, long, long>, int> standing;
  std::vector<Point> marks;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    const Vec3& p = positions[k];
    const Vec3 outward{normals[k].x, normals[k].y, 0};
    const double flat = length(outward);
    const double nx = flat > 1e-6 ? outward.x / flat : 0, ny = flat > 1e-6 ? outward.y / flat : -1;
    const auto key =
        std::tuple{std::lround(p.x * 50), std::lround(p.y * 50), std::lround(nx * 10), std::lround(ny * 10)};
    const double out = radius * (1.15 + 2.3 * standing[key]++);
    const Point at = view.at(p.x, p.y);
    marks.push_back({at.x + out * nx, at.y - out * ny});
  }
  return marks;
}

}  // namespace shelfbeam
