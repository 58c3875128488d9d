#include "shelfbeam/scene/store/value_marks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/fields/problems.hpp"
#include "shelfbeam/base/json.hpp"
#include "shelfbeam/scene/read_values.hpp"

namespace shelfbeam {

namespace {

using Json = nlohmann::ordered_json;

struct Place {
  ValueKind kind;
  std::string_view list, key;
};
constexpr auto places = std::to_array<Place>({{ValueKind::threshold, "label_types", "threshold"},
                                              {ValueKind::responsivity, "label_types", "responsivity"},
                                              {ValueKind::power, "transceiver_types", "emission"},
                                              {ValueKind::price, "transceiver_types", "cost"},
                                              {ValueKind::reflectance, "materials", "reflectance"},
                                              {ValueKind::height, "room", "height"}});

const Place& place_of(ValueKind kind) {
  return *std::ranges::find(places, kind, &Place::kind);
}

// Multiplies all numbers.
Json scaled(Json json, double factor) {
  if (json.is_number()) return json.get<double>() * factor;
  for (Json& part : json) part = scaled(part, factor);
  return json;
}

Json read_mark(const JsonCursor& json, ValueKind kind) {
  switch (kind) {
    case ValueKind::threshold:
      return read_quantity(json);
    case ValueKind::price:
      return read_amount(json);
    case ValueKind::reflectance:
      return json.number(0, 1);
    case ValueKind::height: {
      if (!json.is_array()) return read_length(json);
      Json points = Json::array();
      for (const JsonCursor& point : json.elements()) {
        const Vec3 p = read_point(point);
        points.push_back({p.x, p.y, p.z});
      }
      return points;
    }
    case ValueKind::power:
    case ValueKind::responsivity:
      break;
  }
  if (!json.is_object()) json.fail("is not an object", "give the value as its element has it");
  return json.value();
}

void read_marks_of(const JsonCursor& element, std::string_view list, const std::string& name,
                   ValueState state, std::vector<DecisiveValue>& marks) {
  std::vector<std::string_view> keys;
  for (const Place& place : places)
    if (place.list == list) keys.push_back(place.key);
  element.expect_keys(keys);
  for (const Place& place : places)
    if (place.list == list)
      if (const auto found = element.find(place.key))
        marks.push_back({place.kind, name, state, 0, read_mark(*found, place.kind).dump()});
}

bool same(const Json& one, const Json& other) {
  constexpr double rounding = 1e-6;
  if (one.is_number() && other.is_number()) {
    const auto a = one.get<double>(), b = other.get<double>();
    return std::abs(a - b) <= rounding * std::max(std::abs(a), std::abs(b));
  }
  if (one.type() != other.type() || one.size() != other.size()) return false;
  if (one.is_array()) return std::ranges::equal(one, other, same);
  if (!one.is_object()) return one == other;
  return std::ranges::all_of(one.items(), [&](const auto& member) {
    const auto found = other.find(member.key());
    return found != other.end() && same(member.value(), *found);
  });
}

}  // namespace

std::vector<DecisiveValue> read_marks(const JsonCursor& section, ValueState state, Problems& problems) {
  std::vector<DecisiveValue> marks;
  section.expect_keys({"label_types", "transceiver_types", "materials", "room"});
  for (const auto& [key, list] : section.members())
    problems.collect([&, &key = key, &list = list] {
      if (key == place_of(ValueKind::height).list) return read_marks_of(list, key, "", state, marks);
      for (const auto& [name, element] : list.members())
        problems.collect(
            [&, &name = name, &element = element] { read_marks_of(element, key, name, state, marks); });
    });
  return marks;
}

std::string mark_pointer(const DecisiveValue& value) {
  const Place& place = place_of(value.kind);
  Json::json_pointer pointer;
  pointer /= std::string(place.list);
  if (!value.of.empty()) pointer /= value.of;
  pointer /= std::string(place.key);
  return pointer.to_string();
}

Json mark_json(const DecisiveValue& value, LengthUnit unit) {
  Json json = Json::parse(value.value);
  return value.kind == ValueKind::height ? scaled(std::move(json), 1 / to_metres(1, unit)) : json;
}

Json to_json(const DecisiveValue& value, LengthUnit unit) {
  return {{"kind", to_text(value.kind)},   {"of", value.of},
          {"state", to_text(value.state)}, {"amount", value.amount},
          {"mark", mark_pointer(value)},   {"value", mark_json(value, unit)}};
}

Json marks_section(std::span<const DecisiveValue> values, ValueState state) {
  Json section;
  for (const DecisiveValue& value : values) {
    if (value.state != state) continue;
    const Place& place = place_of(value.kind);
    Json& list = section[std::string(place.list)];
    Json& element = value.of.empty() ? list : list[value.of];
    element[std::string(place.key)] = mark_json(value, LengthUnit::m);
  }
  return section;
}

bool same_value(std::string_view one, std::string_view other) {
  return same(Json::parse(one), Json::parse(other));
}

}  // namespace shelfbeam
