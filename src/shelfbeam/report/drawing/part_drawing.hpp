#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "shelfbeam/report/drawing/plan_view.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// A fixture's own directions: u along it, v across it, both from its rotation.
struct Directions {
  double c, s;

  explicit Directions(double rotation_deg)
      : c(std::cos(rotation_deg * std::numbers::pi / 180)),
        s(std::sin(rotation_deg * std::numbers::pi / 180)) {}
  double u(double x, double y) const { return c * x + s * y; }
  double v(double x, double y) const { return c * y - s * x; }
};

/// How far a fixture reaches along them.
struct Outline {
  Span u, v;

  Outline(const Directions& d, const FixtureOutline& fixture) {
    for (const auto& [x, y] : fixture.footprint) {
      u.add(d.u(x, y));
      v.add(d.v(x, y));
    }
  }
};

/// CSS class of a part; goods alternate between a few colours from place to place, as products do.
std::string part_class(const Part& part);

/// Parts in plan from the lowest top to the highest, without those that a board of their fixture hides from
/// above.
std::vector<std::uint32_t> parts_seen_from_above(const Scene& scene);

/// CSS rules of `part_class` and of everything else in a stand-alone drawing.
std::string drawing_style();

/// What a part that is a mesh covers of the plan, as SVG path data: its triangles, all turned the same way,
/// so that filling leaves no holes where they overlap. A stroke painted before the fill (`paint-order`) shows
/// on the outline alone. Empty for what is no mesh, stands upright, or has more triangles than a drawing
/// should hold; the part's footprint stands for it then.
std::string mesh_silhouette(const PlanView& view, const Scene& scene, const Part& part);

/// That of all parts of a fixture; empty unless every one that covers something has one.
std::string mesh_silhouette(const PlanView& view, const Scene& scene, std::uint32_t fixture);

/// The fixture that carries most labels: those within 0.1 m of its outline and no higher than it. Nothing
/// where no fixture carries any.
std::optional<std::uint32_t> fixture_with_most_labels(const Scene& scene);

/// Side view of one fixture from the face with most labels, and its end view beside it: what stands nearer
/// hides what is behind. Draws below `top` into `width` units and returns the height it took.
double draw_elevation(SvgCanvas& canvas, const Scene& scene, std::uint32_t fixture, double top, double width);

}  // namespace shelfbeam
