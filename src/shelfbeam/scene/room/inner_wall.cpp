#include <algorithm>
#include <cmath>
#include <variant>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/scene/room/room.hpp"

namespace shelfbeam {

void expect_pane(const NamedMaterial& material, const std::string& where) {
  if (std::holds_alternative<Dielectric>(material.material))
    throw InputError(
        where,
        fmt::format("{} is a solid 'dielectric', but a pane has no thickness", in_quotes(material.name)),
        "use a 'thin_dielectric', which models a whole pane");
}

void add_wall_parts(const Room& room, std::size_t wall, const TriangleRange& surface, Scene& scene) {
  const InnerWall& shape = room.shape.inner_walls[wall];
  const double length = shape.length();
  const Polygon outline = shape.footprint(0, length);
  double height = shape.height.value_or(0);
  if (!shape.height)
    for (const Vec2& corner : outline) height = std::max(height, room.shape.ceiling_over(corner).at(corner));
  const auto index = static_cast<std::uint32_t>(scene.fixtures.size());
  const double turn = std::atan2(shape.to[1] - shape.from[1], shape.to[0] - shape.from[0]);
  scene.fixtures.push_back(
      {shape.id, "wall", outline, height, turn * 180 / pi, surface.first, surface.count});
  const auto add = [&](double begin, double end, double bottom, double top) {
    if (end > begin && top > bottom)
      scene.parts.push_back(
          {PartKind::solid, index, room.inner_walls[wall].wall, shape.footprint(begin, end), bottom, top});
  };
  std::vector<WallOpening> openings = shape.openings;
  std::sort(openings.begin(), openings.end(),
            [](const WallOpening& a, const WallOpening& b) { return a.at < b.at; });
  double from = 0;
  for (const WallOpening& opening : openings) {
    const double end = opening.at + opening.width;
    add(from, opening.at, 0, height);
    add(opening.at, end, 0, opening.bottom);
    add(opening.at, end, std::min(opening.top, height), height);
    from = std::max(from, end);
  }
  add(from, length, 0, height);
}

}  // namespace shelfbeam
