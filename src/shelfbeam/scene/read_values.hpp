#pragma once

#include <string>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/scene/store.hpp"

namespace shelfbeam {

// The values a store file is made of. The limits catch slips of the unit or of the keyboard before they
// become a scene that fits into no memory; data/store.schema.json states the same ones. All throw InputError.

/// A coordinate, within 10 km of the origin.
double check_coordinate(double value, const std::string& where);
double read_coordinate(const JsonCursor& cursor);
Vec2 read_plan_point(const JsonCursor& cursor);
Vec3 read_point(const JsonCursor& cursor);

/// A size or distance, 1 mm to 1 km.
double read_length(const JsonCursor& cursor);

/// Within a full turn in either sense, in degrees.
double read_angle_deg(const JsonCursor& cursor);

/// A physical quantity that cannot vanish: 1e-12 to 1e9.
double read_quantity(const JsonCursor& cursor);
/// A cost or an intensity: 0 to 1e9.
double read_amount(const JsonCursor& cursor);

/// Made unit unless it is already, to rounding. Throws for the zero vector.
Vec3 read_direction(const JsonCursor& cursor);
Vec3 unit_direction(const Vec3& v, const std::string& where);

/// An id or a name: not empty, without control characters, which would break lines of messages and tables.
std::string check_name(std::string name, const std::string& where);
std::string read_name(const JsonCursor& cursor);

}  // namespace shelfbeam
