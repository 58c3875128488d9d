#pragma once

#include <array>
#include <string>
#include <string_view>

#include "shelfbeam/base/fields/fields.hpp"
#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/scene/variation.hpp"

namespace shelfbeam {

// Values of special forms, as keys of several structs.

/// Three numbers of a kind.
inline bool describe_triple(Fields& f, std::string_view key, Scalar kind, Vec3& value, const Field& field) {
  std::array<double, 3> values{value.x, value.y, value.z};
  if (!f.array(key, kind, values, field)) return false;
  value = {values[0], values[1], values[2]};
  return true;
}
inline bool describe_point(Fields& f, std::string_view key, Vec3& value, const Field& field) {
  return describe_triple(f, key, Scalar::coordinate, value, field);
}
/// A direction of any length, which becomes 1.
bool describe_direction(Fields& f, std::string_view key, Vec3& direction, const Field& field);
/// An optional text for people, which may be empty.
bool describe_note(Fields& f, std::string_view key, std::string& text, std::string_view says);
/// A share, or a range of shares.
bool describe_share_range(Fields& f, std::string_view key, Range& range, const Field& field);
/// "room", "room without zones", the id of a zone, or a polygon. The reader does not look up the id.
bool describe_plan_area(Fields& f, PlanArea& area, std::string_view says);

}  // namespace shelfbeam
