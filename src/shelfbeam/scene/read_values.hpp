#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "shelfbeam/base/fields/fields.hpp"
#include "shelfbeam/base/json.hpp"
#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

// Readers of values in a store file; all throw InputError. Their limits, also in data/store.schema.json,
// catch wrong units of measure and typing errors before they produce a scene that exceeds the memory.

// Lengths and coordinates are given in the unit of the store file and returned in metres.

/// A coordinate, within 10 km of the origin.
double read_coordinate(const JsonCursor& cursor);
double read_coordinate(double value, LengthUnit unit, const std::string& where);
Vec2 read_plan_point(const JsonCursor& cursor);
Vec3 read_point(const JsonCursor& cursor);
/// Corners in either direction, at most 1,000, with edges that do not cross or touch.
Polygon read_polygon(const JsonCursor& cursor);

/// A length or a point in metres for messages, in the unit of the file: "3.2 m", "(6, 4) m".
std::string length_text(double metres, LengthUnit unit);
std::string point_text(const Vec2& metres, LengthUnit unit);

/// A size or distance, 1 mm to 1 km.
double read_length(const JsonCursor& cursor);

/// The size of a device: 0 for a point, or `smallest` to 10 m.
double read_extent(const JsonCursor& cursor, double smallest);

inline constexpr double min_quantity = 1e-12, largest_amount = 1e9;

/// A physical quantity that cannot vanish: 1e-12 to 1e9.
double read_quantity(const JsonCursor& cursor);
/// A cost or an intensity: 0 to 1e9.
double read_amount(const JsonCursor& cursor);
/// A number of the kind, within the limits of the field.
double read_scalar(const JsonCursor& json, Scalar kind, const Field& field = {});
/// The currency of costs, such as "EUR": 1 to 8 printable characters.
std::string read_currency(const JsonCursor& cursor);
/// A row with one amount per angle.
std::vector<double> read_amounts(const JsonCursor& row, std::size_t angles);

/// At least one angle, ascending within 0 to `last_deg` degrees; returned in radians.
std::vector<double> read_angles(const JsonCursor& cursor, double last_deg);
std::vector<double> read_angles_from_zero(const JsonCursor& cursor, double last_deg);
/// The angle in degrees, 0 to 360, that `radians` converts to `angle` to the bit. It exists for every angle
/// that was converted from degrees; otherwise the next larger angle is returned.
double degrees_of(double angle);

/// The direction of a vector from outside, whose squares may overflow or vanish: every such vector comes
/// through here. All finite vectors but zero are taken, and those whose length is 1 within rounding stay as
/// they are.
Vec3 read_direction(const JsonCursor& cursor);
Vec3 unit_direction(const Vec3& v, const std::string& where);

/// Throws InputError for characters that control a terminal, change the direction of writing or are
/// invisible: they would break messages and tables, or make a name look like another.
void expect_printable(const std::string& text, const std::string& where);
/// An id or a name: not empty, and printable.
std::string check_name(std::string name, const std::string& where);
std::string read_name(const JsonCursor& cursor);
/// The same for a key of an object; no member of `list`, from another file, has the name.
template <class List>
std::string new_name(const std::string& name, const List& list, const JsonCursor& cursor) {
  for (const auto& other : list)
    if (other.name == name) cursor.fail("has a name that another file uses, too", "rename one of the two");
  return check_name(name, cursor.where());
}

/// The result of `make`. A std::invalid_argument from it becomes an InputError at this position.
template <class Make>
auto make_or_fail(const JsonCursor& cursor, Make make) {
  try {
    return make();
  } catch (const std::invalid_argument& refused) {
    cursor.fail(refused.what());
  }
}

}  // namespace shelfbeam
