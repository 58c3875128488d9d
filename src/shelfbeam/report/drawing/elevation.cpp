#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/drawing/fixture_look.hpp"
#include "shelfbeam/report/drawing/part_drawing.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

std::string title_of(const Label& label) {
  return label.description.empty() ? label.id : fmt::format("{} ({})", label.description, label.id);
}

// A part or label in a side view: its extent across, its heights, and its nearness to the viewer.
struct Seen {
  Span across;
  double bottom, top, nearness;
  const Part* part;
};

std::vector<LabelId> labels_of(const Scene& scene, const FixtureOutline& fixture) {
  constexpr double reach = 0.1;  // m
  const Directions d(fixture.rotation_deg);
  const Outline outline(d, fixture);
  // A rectangle is its extent; other outlines, such as that of an L-shaped counter, are not.
  const auto is_near = [&](const Vec2& p) {
    return fixture.footprint.size() == 4 || contains(fixture.footprint, p) ||
           distance_to_border(fixture.footprint, p) < reach;
  };
  std::vector<LabelId> labels;
  for (std::uint32_t i = 0; i < scene.labels.size(); ++i) {
    const Vec3& p = scene.labels[i].position;
    const double u = d.u(p.x, p.y), v = d.v(p.x, p.y);
    if (u > outline.u.low - reach && u < outline.u.high + reach && v > outline.v.low - reach &&
        v < outline.v.high + reach && p.z <= fixture.height + reach && is_near({p.x, p.y}))
      labels.push_back(i);
  }
  return labels;
}

// Sorted from far to near, so that near parts cover far parts.
std::vector<Seen> view_parts(const Scene& scene, std::uint32_t fixture, const Directions& d, bool from_side,
                             double towards) {
  std::vector<Seen> seen;
  for (const Part& part : scene.parts) {
    if (part.fixture != fixture || part.kind == PartKind::shell) continue;
    Span across, depth;
    for (const auto& [x, y] : part.footprint) {
      across.add(from_side ? d.u(x, y) : d.v(x, y));
      depth.add(from_side ? d.v(x, y) : d.u(x, y));
    }
    seen.push_back({across, part.bottom, part.top, towards > 0 ? depth.high : -depth.low, &part});
  }
  std::stable_sort(seen.begin(), seen.end(),
                   [](const Seen& a, const Seen& b) { return a.nearness < b.nearness; });
  return seen;
}

// The corners of a parallelogram of two triangles, a b c and a c d.
std::array<Vec3, 4> corners_of_panel(const Scene& scene, const FixtureOutline& panel) {
  const auto& [a, b, c] = scene.mesh.triangles[panel.first_triangle];
  const std::uint32_t d = scene.mesh.triangles[panel.first_triangle + 1][2];
  const auto& v = scene.mesh.vertices;
  return {v[a], v[b], v[c], v[d]};
}

}  // namespace

std::optional<std::uint32_t> fixture_with_max_labels(const Scene& scene) {
  std::optional<std::uint32_t> best;
  std::size_t max_count = 0;
  for (std::uint32_t f = 0; f < scene.fixtures.size(); ++f) {
    if (!has_plan(scene.fixtures[f]) || scene.fixtures[f].is_wall()) continue;
    const std::size_t count = labels_of(scene, scene.fixtures[f]).size();
    if (count > max_count) {
      max_count = count;
      best = f;
    }
  }
  return best;
}

double draw_elevation(SvgCanvas& canvas, const Scene& scene, std::uint32_t index, double top, double width) {
  const Words words = words_of(scene);
  constexpr double left = 52, right = 60, gap = 78, heading = 58, below = 30;
  const FixtureOutline& fixture = scene.fixtures[index];
  const Directions d(fixture.rotation_deg);
  const Outline outline(d, fixture);
  const std::vector<LabelId> labels = labels_of(scene, fixture);

  const auto facing = [&](LabelId i) { return d.v(scene.labels[i].normal.x, scene.labels[i].normal.y); };
  const auto front = std::count_if(labels.begin(), labels.end(), [&](auto i) { return facing(i) < -0.5; });
  const auto back = std::count_if(labels.begin(), labels.end(), [&](auto i) { return facing(i) > 0.5; });
  const double towards = back > front ? 1 : -1;  // the viewer is at large or at small v

  const double scale = std::min((width - left - right - gap) / (outline.u.size() + outline.v.size()), 190.0);
  const double ground = top + heading + fixture.height * scale;
  const auto up = [&](double z) { return ground - z * scale; };
  // In the view from the back, u points to the left.
  const auto side_x = [&](double u) {
    return left + (towards < 0 ? u - outline.u.low : outline.u.high - u) * scale;
  };
  const double end_left = left + outline.u.size() * scale + gap;
  const auto end_x = [&](double v) { return end_left + (v - outline.v.low) * scale; };

  canvas.text({left, top + 16}, words.say("drawing.elevation.title", fixture.id), "title");
  canvas.text(
      {left, top + 38},
      words.say("drawing.elevation.size", words.grouped(labels.size()), words.fixed(outline.u.size(), 2),
                words.fixed(outline.v.size(), 2), words.fixed(fixture.height, 2)),
      "sub");
  const auto draw = [&](const std::vector<Seen>& parts, const auto& x, const auto& across) {
    for (const Seen& seen : parts) {
      if (fixture.form == FixtureForm::sheet) {
        std::vector<Point> corners;
        for (const Vec3& corner : corners_of_panel(scene, fixture))
          corners.push_back({x(across(corner.x, corner.y)), up(corner.z)});
        canvas.polygon(corners, part_class(*seen.part));
        continue;
      }
      const double a = x(seen.across.low), b = x(seen.across.high);
      canvas.rect({std::min(a, b), up(seen.top)}, std::abs(b - a), (seen.top - seen.bottom) * scale,
                  part_class(*seen.part));
    }
  };
  draw(view_parts(scene, index, d, true, towards), side_x, [&](double x, double y) { return d.u(x, y); });
  draw(view_parts(scene, index, d, false, -1), end_x, [&](double x, double y) { return d.v(x, y); });

  std::vector<double> heights;
  for (const LabelId i : labels) {
    const Vec3& p = scene.labels[i].position;
    if (facing(i) * towards > 0.5)
      canvas.rect({side_x(d.u(p.x, p.y)) - 3.5, up(p.z) - 2.5}, 7, 5, "tag", title_of(scene.labels[i]));
    const double out = facing(i);
    const Point at{end_x(d.v(p.x, p.y)), up(p.z)};
    canvas.line(at, {at.x + 7 * out, at.y - 7 * scene.labels[i].normal.z}, "label");
    heights.push_back(p.z);
  }
  canvas.line({left - 12, ground}, {left + outline.u.size() * scale + 12, ground}, "ground");
  canvas.line({end_left - 12, ground}, {end_left + outline.v.size() * scale + 12, ground}, "ground");
  canvas.text({end_left + outline.v.size() * scale / 2, ground + 21}, words("drawing.elevation.end"),
              "t mid");
  canvas.text({left + outline.u.size() * scale / 2, ground + 21},
              words.say("drawing.metres", words.fixed(outline.u.size(), 2)), "t mid");

  // Heights of the labels between the two views, height of the fixture on the left.
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end(), [](double a, double b) { return b - a < 0.02; }),
                heights.end());
  const double right_edge = left + outline.u.size() * scale;
  double last = 1e9;
  for (const double z : heights) {
    canvas.line({right_edge + 3, up(z)}, {right_edge + 10, up(z)}, "tick");
    if (last - up(z) < 14) continue;
    canvas.text({right_edge + 14, up(z) + 4}, words.say("drawing.metres", words.fixed(z, 2)), "t");
    last = up(z);
  }
  for (const double z : {0.0, fixture.height}) {
    canvas.line({left - 10, up(z)}, {left - 3, up(z)}, "tick");
    canvas.text({left - 14, up(z) + 4}, words.fixed(z, 2), "t end");
  }
  return heading + fixture.height * scale + below;
}

}  // namespace shelfbeam
