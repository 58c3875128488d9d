#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/report/data/report_data.hpp"
#include "shelfbeam/report/mounting/reference.hpp"
#include "shelfbeam/report/place/shop_place.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

/// A row of the mounting sheet: a chosen unit as a fitter mounts it. Lengths in whole centimetres.
struct MountedUnit {
  std::size_t number = 0;  ///< in the table and on the drawings: the place in walking order, from 1
  std::string id, type;
  bool installed = false, pinned = false;
  Vec3 position;  ///< m
  std::array<Reference, 2> references;
  ShopPlace place;
  double tolerance = 0;           ///< by which it may be off in plan, m (tolerances_of); 0: unknown
  std::string order_number = {};  ///< of its type; may be empty
  double tilt_deg = 0;            ///< of the axis from straight down
  double towards_deg = 0;  ///< in plan, from the x axis towards the y axis; 0 for a unit that points down
  double roll_deg = 0;
};

/// One row per chosen unit, in walking order.
std::vector<MountedUnit> mounting_sheet(const ReportInput& input);

/// Heights above it need a lift or a scaffold: a tall stepladder reaches it, m.
inline constexpr double ladder_reach = 4;

inline bool needs_lift(const MountedUnit& unit) {
  return !unit.installed && unit.position.z > ladder_reach;
}

/// A length rounded to 1 cm.
long centimetres(double metres);

/// The height of the unit above the floor (z = 0), as rounded.
inline long height_cm(const MountedUnit& unit) {
  return centimetres(unit.position.z);
}

/// The distance of the unit from a ceiling of several heights, as rounded; empty below a ceiling of one
/// height.
std::optional<long> cm_below_ceiling(const Scene& scene, const MountedUnit& unit);

/// "wall at the left", "A3", "left side of A3", "edge of the ceiling at 2.60 m", "axis of the drawing"
std::string name_of(const Words& words, const Reference& reference);
std::string_view side_text(const Words& words, Side side);

/// A tilt so small that the unit points straight down.
inline constexpr double min_tilt_deg = 0.5;

/// "straight down", "straight up", "30° towards the top left", with the angle in plan unless it is a multiple
/// of 45°; then the turn about its own axis.
std::string direction_of(const Words& words, const MountedUnit& unit);

}  // namespace shelfbeam
