#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/scene/scene.hpp"

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
/// That of the key "rotation_deg"; 0 without one.
double read_rotation_deg(const JsonCursor& fixture);

/// The size of a device: 0 for a point, or `least` to 10 m.
double read_extent(const JsonCursor& cursor, double least);

inline constexpr double least_quantity = 1e-12, largest_amount = 1e9;

/// A physical quantity that cannot vanish: 1e-12 to 1e9.
double read_quantity(const JsonCursor& cursor);
/// A cost or an intensity: 0 to 1e9.
double read_amount(const JsonCursor& cursor);
/// One amount for each of so many angles.
std::vector<double> read_amounts(const JsonCursor& row, std::size_t angles);

/// Angles that ascend within 0 to `last_deg` degrees, in radians; at least one.
std::vector<double> read_angles(const JsonCursor& cursor, double last_deg);
std::vector<double> read_angles_from_zero(const JsonCursor& cursor, double last_deg);
/// The angle in degrees, 0 to 360, that `radians` turns into just this one, to the bit, if there is one
/// (there is for every angle that came from degrees), else the next larger.
double degrees_of(double angle);

/// Made unit unless it is already, to rounding. Throws for the zero vector.
Vec3 read_direction(const JsonCursor& cursor);
Vec3 unit_direction(const Vec3& v, const std::string& where);

/// An id or a name: not empty, without control characters, which would break lines of messages and tables.
std::string check_name(std::string name, const std::string& where);
std::string read_name(const JsonCursor& cursor);

/// What `make` gives; what it refuses by std::invalid_argument is an error at this place.
template <class Make>
auto made_at(const JsonCursor& cursor, Make make) {
  try {
    return make();
  } catch (const std::invalid_argument& refused) {
    cursor.fail(refused.what());
  }
}

}  // namespace shelfbeam
