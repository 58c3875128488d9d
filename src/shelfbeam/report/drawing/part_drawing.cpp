#include "shelfbeam/report/drawing/part_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace shelfbeam {

namespace {

struct Box {
  Span x, y;

  explicit Box(const Part& part) {
    for (const Vec2& corner : part.footprint) {
      x.add(corner[0]);
      y.add(corner[1]);
    }
  }
  bool holds(const Box& other) const {
    constexpr double slack = 1e-6;
    return other.x.low > x.low - slack && other.x.high < x.high + slack && other.y.low > y.low - slack &&
           other.y.high < y.high + slack;
  }
};

constexpr std::uint32_t max_drawn_triangles = 2000;  // per part: about 60 kB in the drawing
constexpr double min_area = 1e-6;                    // m^2, in plan

}  // namespace

std::string part_class(const Part& part) {
  constexpr const char* classes[] = {"shell", "panel",  "board", "kick",  "goods",
                                     "tub",   "casing", "door",  "solid", "mesh"};
  return classes[static_cast<std::size_t>(part.kind)];
}

std::vector<std::uint32_t> parts_seen_from_above(const Scene& scene) {
  std::vector<std::vector<std::uint32_t>> boards(scene.fixtures.size());
  std::vector<Box> boxes;
  for (std::uint32_t k = 0; k < scene.parts.size(); ++k) {
    const Part& part = scene.parts[k];
    boxes.emplace_back(part);
    if (part.kind == PartKind::board && part.fixture < boards.size()) boards[part.fixture].push_back(k);
  }
  const auto hidden = [&](std::uint32_t k) {
    const Part& part = scene.parts[k];
    if (part.fixture >= boards.size()) return false;
    return std::any_of(boards[part.fixture].begin(), boards[part.fixture].end(), [&](std::uint32_t board) {
      return board != k && scene.parts[board].bottom > part.top - 1e-6 && boxes[board].holds(boxes[k]);
    });
  };
  std::vector<std::uint32_t> seen;
  for (std::uint32_t k = 0; k < scene.parts.size(); ++k)
    if (scene.parts[k].kind != PartKind::shell && scene.parts[k].footprint.size() > 2 && !hidden(k))
      seen.push_back(k);
  std::stable_sort(seen.begin(), seen.end(),
                   [&](auto a, auto b) { return scene.parts[a].top < scene.parts[b].top; });
  return seen;
}

std::string drawing_style(const Scene& scene) {
  std::string style = R"(
text{font-family:system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue","Liberation Sans",Arial,sans-serif;fill:#1b2228}
.title{font-size:24px;font-weight:650}.sub{font-size:15px;fill:#57626d}
.t{font-size:13px;fill:#57626d}.mid{text-anchor:middle}.end{text-anchor:end}
.paper{fill:#fff}.floor{fill:#fbfbf8;stroke:#4b555e;stroke-width:2}
.tick{stroke:#5d6973;stroke-width:1}.bar-full{fill:#5d6973;stroke:#5d6973}.bar-empty{fill:none;stroke:#5d6973}
.panel{fill:#87919a}.board{fill:#d9dde0;stroke:#7d8790;stroke-width:.7}.kick{fill:#59636c}
.goods{fill:#d8d2c6;stroke:#4a4136;stroke-opacity:.45;stroke-width:.5}
.tub{fill:#e3eef4;stroke:#6f8794;stroke-width:.8}.solid{fill:#9aa3ab;stroke:#59636c}.mesh{fill:#c3cad1;stroke:#59636c;stroke-width:1.6;stroke-linejoin:round;paint-order:stroke}
.casing{fill:#87919a;fill-opacity:.15;stroke:#59636c;stroke-width:.7}.door{fill:none;stroke:#6fa8cf;stroke-width:1.2}
.outline{fill:none;stroke:#4b555e;stroke-width:1.2}.over{stroke-dasharray:9 5}
.halo{stroke:#fff;stroke-width:3.5px;stroke-opacity:.85;paint-order:stroke;stroke-linejoin:round}
.fid{font-size:inherit;font-weight:700;stroke:#fff;stroke-width:.22em;stroke-opacity:.8;paint-order:stroke;stroke-linejoin:round}
.label{stroke:#0a4d91;stroke-width:1.4;fill:none}.dot{fill:#0a4d91}
.cand,.aim{stroke:#8a4b00;stroke-width:1;fill:none;stroke-opacity:.75}
.old{fill:#14191e;stroke:#fff;stroke-width:1.5}
.tag{fill:#fff;stroke:#0a4d91;stroke-width:1}
.ground{stroke:#4b555e;stroke-width:2}.guide{stroke:#a9b2ba;stroke-width:.8;stroke-dasharray:3 3}
)";
  if (scene.room && !scene.room->is_plain_box())
    style += R"(.hole{fill:#fff}.zone{fill:none;stroke:#8b959d;stroke-width:1.2;stroke-dasharray:2 4}
.wall{fill:#4b555e;stroke:#4b555e;stroke-width:.8}.wall-low{fill:#e3e6e9;stroke:#4b555e;stroke-width:1}
.pane{fill:none;stroke:#2f7fb8;stroke-width:1.6}
)";
  return style;
}

std::string mesh_silhouette(const PlanView& view, const Scene& scene, const Part& part) {
  if (part.triangle_count == 0 || part.triangle_count > max_drawn_triangles) return {};
  std::string data;
  for (std::uint32_t t = part.first_triangle; t < part.first_triangle + part.triangle_count; ++t) {
    auto [a, b, c] = scene.mesh.triangles[t];
    const Vec3 normal = cross(scene.mesh.vertices[b] - scene.mesh.vertices[a],
                              scene.mesh.vertices[c] - scene.mesh.vertices[a]);
    if (std::abs(normal.z) < 2 * min_area) continue;
    if (normal.z < 0) std::swap(b, c);
    std::vector<Point> corners;
    for (const std::uint32_t corner : {a, b, c})
      corners.push_back(view.at(scene.mesh.vertices[corner].x, scene.mesh.vertices[corner].y));
    data += path_through(corners);
  }
  return data;
}

std::string mesh_silhouette(const PlanView& view, const Scene& scene, std::uint32_t fixture) {
  std::string data;
  for (const Part& part : scene.parts) {
    if (part.fixture != fixture || part.kind == PartKind::shell || part.footprint.size() < 3) continue;
    const std::string of_part = mesh_silhouette(view, scene, part);
    if (of_part.empty()) return {};
    data += of_part;
  }
  return data;
}

}  // namespace shelfbeam
