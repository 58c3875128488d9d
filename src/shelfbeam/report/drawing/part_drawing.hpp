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

/// The coordinate axes of a rotated fixture: u along it, v across it.
struct Directions {
  double c, s;

  explicit Directions(double rotation_deg)
      : c(std::cos(rotation_deg * std::numbers::pi / 180)),
        s(std::sin(rotation_deg * std::numbers::pi / 180)) {}
  double u(double x, double y) const { return c * x + s * y; }
  double v(double x, double y) const { return c * y - s * x; }
};

/// The extent of a fixture along both axes.
struct Outline {
  Span u, v;

  Outline(const Directions& d, const FixtureOutline& fixture) {
    for (const auto& [x, y] : fixture.footprint) {
      u.add(d.u(x, y));
      v.add(d.v(x, y));
    }
  }
};

/// CSS class of a part.
std::string part_class(const Part& part);

/// Parts in the order of their tops, lowest first, without parts below a board of the same fixture.
std::vector<std::uint32_t> parts_seen_from_above(const Scene& scene);

/// CSS rules for `part_class` and all other classes of a stand-alone drawing of the scene.
std::string drawing_style(const Scene& scene);

/// The floor area below a mesh part, as SVG path data: its triangles, all with the same orientation, so that
/// filling leaves no holes where they overlap. A stroke painted before the fill (`paint-order`) is visible on
/// the outline alone. Empty for other parts, for upright meshes and for meshes with too many triangles; these
/// are drawn by their footprint.
std::string mesh_silhouette(const PlanView& view, const Scene& scene, const Part& part);

/// The silhouettes of all parts of a fixture; empty if a part with floor area has none.
std::string mesh_silhouette(const PlanView& view, const Scene& scene, std::uint32_t fixture);

/// The fixture with the most labels. Its labels are those within 0.1 m of its outline that are not above it.
/// Empty if no fixture has labels.
std::optional<std::uint32_t> fixture_with_max_labels(const Scene& scene);

/// Side view of one fixture from the face with the most labels, and end view; near parts hide far parts.
/// Draws below `top` with the given width and returns the height, both in drawing units.
double draw_elevation(SvgCanvas& canvas, const Scene& scene, std::uint32_t fixture, double top, double width);

}  // namespace shelfbeam
