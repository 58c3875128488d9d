#include "shelfbeam/report/mounting/mounting_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <fmt/format.h>

#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/mounting/tolerance.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

constexpr double degree = std::numbers::pi / 180;

}  // namespace

std::vector<MountedUnit> mounting_sheet(const ReportInput& input) {
  std::map<std::string_view, double> roll_deg;
  for (const Transceiver& unit : input.scene.transceivers) roll_deg.emplace(unit.id, unit.roll_deg);
  const ShopPlaces places(input.scene);
  const std::vector<double> tolerances = tolerances_of(input);
  std::vector<MountedUnit> sheet;
  for (const std::size_t k : walking_order_of(input)) {
    const TransceiverColumn& of = input.matrix.transceivers[input.plan.placement.selected[k]];
    MountedUnit unit{sheet.size() + 1,
                     of.id,
                     of.type,
                     of.installed,
                     of.pinned,
                     of.position,
                     references_of(input.scene, of.position),
                     places.of(of.position)};
    unit.tolerance = tolerances[k];
    if (const TransceiverType* const type = unit_type(input.scene, of.type))
      unit.order_number = type->order_number;
    const double level = std::hypot(of.axis.x, of.axis.y);
    unit.tilt_deg = std::atan2(level, -of.axis.z) / degree;
    if (level > 1e-9) unit.towards_deg = std::fmod(std::atan2(of.axis.y, of.axis.x) / degree + 360, 360);
    unit.roll_deg = roll_deg[of.id];
    sheet.push_back(std::move(unit));
  }
  return sheet;
}

std::optional<long> cm_below_ceiling(const Scene& scene, const MountedUnit& unit) {
  if (!scene.room || scene.room->has_one_height()) return {};
  const Vec2 plan{unit.position.x, unit.position.y};
  return std::max(0L, centimetres(scene.room->ceiling_over(plan).at(plan) - unit.position.z));
}

long centimetres(double metres) {
  return std::lround(100 * metres);
}

std::string name_of(const Words& words, const Reference& reference) {
  const std::string_view side = side_text(words, reference.side);
  switch (reference.kind) {
    case Reference::Kind::wall:
      return words.say("mounting.wall", side);
    case Reference::Kind::fixture:
      return reference.fixture;
    case Reference::Kind::end:
      return words.say("mounting.end", side, reference.fixture);
    case Reference::Kind::ceiling:
      return words.say("mounting.ceiling", words.fixed(reference.ceiling, 2));
    case Reference::Kind::origin:
      break;
  }
  return words.say("mounting.origin");
}

std::string_view side_text(const Words& words, Side side) {
  constexpr const char* keys[] = {"left", "right", "bottom", "top"};
  return words(fmt::format("mounting.side.{}", keys[static_cast<std::size_t>(side)]));
}

std::string direction_of(const Words& words, const MountedUnit& unit) {
  constexpr double eighth = 45;  // degrees
  std::string text;
  if (unit.tilt_deg < min_tilt_deg)
    text = words.say("mounting.down");
  else if (unit.tilt_deg > 180 - min_tilt_deg)
    text = words.say("mounting.up");
  else {
    const long nearest = std::lround(unit.towards_deg / eighth);
    const std::string_view side = words(fmt::format("mounting.towards.{}", nearest % 8));
    const bool is_exact = std::abs(unit.towards_deg - eighth * static_cast<double>(nearest)) < 1;
    text = is_exact ? words.say("mounting.tilted", words.fixed(unit.tilt_deg, 0), side)
                    : words.say("mounting.tilted_to", words.fixed(unit.tilt_deg, 0), side,
                                words.fixed(unit.towards_deg, 0));
  }
  return unit.roll_deg == 0 ? text : words.say("mounting.turned", text, words.plain(unit.roll_deg));
}

}  // namespace shelfbeam
