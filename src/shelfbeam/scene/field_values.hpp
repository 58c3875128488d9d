#pragma once

#include <array>
#include <string_view>

#include "shelfbeam/base/fields/fields.hpp"
#include "shelfbeam/math/vec3.hpp"

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

}  // namespace shelfbeam
