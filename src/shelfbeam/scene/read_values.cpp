#include "shelfbeam/scene/read_values.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/math/warp.hpp"

namespace shelfbeam {

double read_coordinate(double value, LengthUnit unit, const std::string& where) {
  constexpr double farthest = 1e4;
  const double metres = to_metres(value, unit);
  if (!(std::abs(metres) <= farthest))
    throw InputError(where, fmt::format("is at {} {}", value, to_text(unit)),
                     "it must be within 10 km of the origin; check its unit of length");
  return metres;
}

double read_coordinate(const JsonCursor& cursor) {
  return read_coordinate(cursor.number(), cursor.unit(), cursor.where());
}

Vec2 read_plan_point(const JsonCursor& cursor) {
  cursor.numbers(2);
  const auto v = cursor.elements();
  return {read_coordinate(v[0]), read_coordinate(v[1])};
}

Polygon read_polygon(const JsonCursor& cursor) {
  constexpr std::size_t max_corners = 1000;
  if (cursor.size() > max_corners)
    cursor.fail(fmt::format("has {} corners", cursor.size()),
                fmt::format("at most {} are allowed", max_corners));
  Polygon polygon;
  for (const JsonCursor& corner : cursor.elements()) polygon.push_back(read_plan_point(corner));
  if (polygon.size() < 3) cursor.fail("has fewer than three corners", "give all its corners [x, y] in order");
  if (polygon.front() == polygon.back())
    cursor.fail("repeats its first corner at the end",
                "remove the last corner; polygons close by themselves");
  if (const auto fault = fault_of(polygon))
    cursor.fail(fmt::format("{} at {}", fault->problem, point_text(fault->at, cursor.unit())), fault->remedy);
  return polygon;
}

std::string length_text(double metres, LengthUnit unit) {
  return fmt::format("{:.6g} {}", metres / to_metres(1, unit), to_text(unit));
}

std::string point_text(const Vec2& metres, LengthUnit unit) {
  const double one = to_metres(1, unit);
  return fmt::format("({:.6g}, {:.6g}) {}", metres[0] / one, metres[1] / one, to_text(unit));
}

Vec3 read_point(const JsonCursor& cursor) {
  cursor.numbers(3);
  const auto v = cursor.elements();
  return {read_coordinate(v[0]), read_coordinate(v[1]), read_coordinate(v[2])};
}

double read_length(const JsonCursor& cursor) {
  cursor.positive();
  return cursor.metres(1e-3, 1e3);
}

double read_extent(const JsonCursor& cursor, double smallest) {
  constexpr double largest = 10;
  cursor.non_negative();
  const double value = cursor.metres();
  if (value > 0 && (value < smallest || value > largest))
    cursor.fail(fmt::format("is {}, which is outside {} to {} m", cursor.length_text(), smallest, largest),
                "use a value in that range, or 0 for a point");
  return value;
}

double read_quantity(const JsonCursor& cursor) {
  cursor.positive();
  return cursor.number(min_quantity, largest_amount);
}

double read_amount(const JsonCursor& cursor) {
  cursor.non_negative();
  return cursor.number(0, largest_amount);
}

namespace {

double read_number(const JsonCursor& json, Scalar kind, const Field& field) {
  const auto within = [&](double low, double high) {
    return json.number(std::max(low, field.least), std::min(high, field.most));
  };
  switch (kind) {
    case Scalar::length:
      return read_length(json);
    case Scalar::distance:
      return json.metres(std::max(0.0, field.least), std::min(1e3, field.most));
    case Scalar::extent:
      return read_extent(json, 1e-4);
    case Scalar::coordinate:
      return read_coordinate(json);
    case Scalar::degrees:
      return within(-360, 360);
    case Scalar::share:
      return within(0, 1);
    case Scalar::quantity:
      return read_quantity(json);
    case Scalar::amount:
      return read_amount(json);
    case Scalar::number:
      break;
  }
  return within(-HUGE_VAL, HUGE_VAL);
}

}  // namespace

double read_scalar(const JsonCursor& json, Scalar kind, const Field& field) {
  const double value = read_number(json, kind, field);
  if (value >= field.least && value <= field.most) return value;
  const bool is_low = value < field.least;
  const double limit = is_low ? field.least : field.most;
  json.fail_limits(fmt::format("is {}, {} {} m", json.length_text(), is_low ? "below" : "above", limit),
                   value, field.least, field.most,
                   std::string(field.remedy.empty() ? "use another value" : field.remedy));
}

std::string read_currency(const JsonCursor& cursor) {
  constexpr std::ptrdiff_t max_characters = 8;
  std::string currency = cursor.text();
  expect_printable(currency, cursor.where());
  const auto starts_character = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; };
  if (currency.empty() || std::count_if(currency.begin(), currency.end(), starts_character) > max_characters)
    cursor.fail(fmt::format("is {}", in_quotes(currency)), "use a code such as \"EUR\"");
  return currency;
}

std::vector<double> read_amounts(const JsonCursor& row, std::size_t angles) {
  std::vector<double> values;
  for (const JsonCursor& value : row.elements()) values.push_back(read_amount(value));
  if (values.size() != angles)
    row.fail(fmt::format("has {} values for {} angles", values.size(), angles),
             "give one value for each theta");
  return values;
}

std::vector<double> read_angles(const JsonCursor& cursor, double last_deg) {
  std::vector<double> angles;
  for (const JsonCursor& element : cursor.elements()) {
    const double angle = radians(element.number(0, last_deg));
    // Compares in radians, because two different angles in degrees may become equal.
    if (!angles.empty() && angle <= angles.back()) cursor.fail("does not ascend", "sort the angles");
    angles.push_back(angle);
  }
  if (angles.empty()) cursor.fail("is empty", "give at least one angle");
  return angles;
}

std::vector<double> read_angles_from_zero(const JsonCursor& cursor, double last_deg) {
  std::vector<double> angles = read_angles(cursor, last_deg);
  if (angles.front() != 0) cursor.fail("does not begin at 0", "angles must ascend from 0");
  return angles;
}

double degrees_of(double angle) {
  const double near = std::round(angle * 180 / pi * 1e6) / 1e6;
  if (radians(near) == angle) return near;
  // Bisection for the smallest angle with radians(degrees) >= angle. `radians` is monotonic in spite of
  // rounding, and the bit patterns of positive numbers have the order of the numbers.
  auto low = std::bit_cast<std::uint64_t>(0.0), high = std::bit_cast<std::uint64_t>(361.0);
  while (low < high) {
    const std::uint64_t middle = low + (high - low) / 2;
    if (radians(std::bit_cast<double>(middle)) < angle)
      low = middle + 1;
    else
      high = middle;
  }
  return std::bit_cast<double>(low);
}

Vec3 unit_direction(const Vec3& v, const std::string& where) {
  // Scales first, so that the squares neither underflow nor overflow.
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!is_finite(v)) throw InputError(where, "is not finite", "give a direction of finite numbers");
  if (!(largest > 0)) throw InputError(where, "is a zero vector", "give a direction");
  return std::abs(length_squared(v) - 1) < 1e-12 ? v
                                                 : normalized({v.x / largest, v.y / largest, v.z / largest});
}

Vec3 read_direction(const JsonCursor& cursor) {
  const auto v = cursor.numbers(3);
  return unit_direction({v[0], v[1], v[2]}, cursor.where());
}

void expect_printable(const std::string& text, const std::string& where) {
  if (const std::string character = unprintable_character(text); !character.empty())
    throw InputError(where, fmt::format("has the unprintable character '{}' in its name", character),
                     "remove it");
}

std::string check_name(std::string name, const std::string& where) {
  if (name.empty()) throw InputError(where, "is empty", "give it a name");
  expect_printable(name, where);
  return name;
}

std::string read_name(const JsonCursor& cursor) {
  return check_name(cursor.text(), cursor.where());
}

}  // namespace shelfbeam
