#include "shelfbeam/scene/planogram/label_sides.hpp"

#include <algorithm>
#include <variant>

#include "shelfbeam/scene/fixture/turn.hpp"

namespace shelfbeam {

std::optional<LabelSides> label_sides(const Fixture& fixture) {
  const auto footing = footing_of(fixture);
  if (!footing) return {};
  if (const auto edges = label_edges(fixture)) return LabelSides{*footing, edges->faces, edges->heights, {}};
  const Box* box = std::get_if<Box>(&fixture);
  if (box == nullptr) return {};
  constexpr double above_top = 0.01;  // m
  const double below_top = std::min(Shelving::label_below_rim, (box->max.z - box->min.z) / 2);
  return LabelSides{*footing,
                    {Face::front, Face::back, Face::left, Face::right},
                    {box->max.z - below_top},
                    box->max.z + above_top};
}

bool LabelSides::has(const std::optional<Face>& face) const {
  return face ? std::find(faces.begin(), faces.end(), *face) != faces.end() : top.has_value();
}

EdgePlace in_store(const Footing& footing, const EdgePlace& local) {
  const auto& [position, normal] = local;
  const Vec2 from_origin = turned({position.x, position.y}, footing.rotation_deg),
             direction = turned({normal.x, normal.y}, footing.rotation_deg);
  return {{footing.at[0] + from_origin[0], footing.at[1] + from_origin[1], position.z},
          {direction[0], direction[1], normal.z}};
}

}  // namespace shelfbeam
