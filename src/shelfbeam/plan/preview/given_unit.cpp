#include "shelfbeam/plan/preview/given_unit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/build/misplaced.hpp"
#include "shelfbeam/scene/read_values.hpp"

namespace shelfbeam {

namespace {

constexpr auto form = "write x,y,z in metres, then the axis as three numbers and the type if they differ";

[[noreturn]] void refuse(std::string_view text, const std::string& why, const std::string& advice = form) {
  throw InputError(fmt::format("unit {}", in_quotes(text)), why, advice);
}

using UnitFields = std::vector<std::string_view>;

std::optional<double> number_of(std::string_view field) {
  const auto value = to_number(field);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::vector<std::string> type_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const TransceiverType& type : scene.transceiver_types) names.push_back(type.name);
  return names;
}

TransceiverTypeId type_named(std::string_view text, std::string_view name, const Scene& scene) {
  const std::vector<std::string> names = type_names(scene);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    refuse(text, fmt::format("names the unknown type {}", in_quotes(name)),
           fmt::format("name one of: {}", fmt::join(names, ", ")));
  return {static_cast<std::uint32_t>(found - names.begin())};
}

// The type of all candidates, or of the store, if there is only one.
TransceiverTypeId common_type(std::string_view text, const Scene& scene) {
  const auto& units = scene.transceivers;
  const bool is_common = !units.empty() && std::all_of(units.begin(), units.end(), [&](const auto& unit) {
    return unit.type.value == units.front().type.value;
  });
  if (is_common) return units.front().type;
  if (scene.transceiver_types.size() == 1) return {0};
  refuse(text, "has no type, and the store has several",
         fmt::format("add one at the end: {}", fmt::join(type_names(scene), ", ")));
}

// Reads position, axis and type from fields[first] on. Values that are not given stay.
void read(std::string_view text, const UnitFields& fields, std::size_t first, const Scene& scene,
          Transceiver& unit) {
  std::vector<double> numbers;
  std::size_t k = first;
  for (; k < fields.size(); ++k) {
    const auto number = number_of(fields[k]);
    if (!number) break;
    numbers.push_back(*number);
  }
  if (numbers.size() != 3 && numbers.size() != 6)
    refuse(text, fmt::format("has {} numbers instead of 3 or 6", numbers.size()));
  if (fields.size() - k > 1) refuse(text, "has more than a type after the numbers");
  unit.position = {numbers[0], numbers[1], numbers[2]};
  if (numbers.size() == 6) {
    const Vec3 axis{numbers[3], numbers[4], numbers[5]};
    unit.axis = unit_direction(axis, fmt::format("axis of unit {}", in_quotes(text)));
  }
  if (k < fields.size()) unit.type = type_named(text, fields[k], scene);
  if (const std::string where = beyond_room(scene, unit.position); !where.empty())
    refuse(text, fmt::format("is outside the room, {}", where), "correct its position");
  for (int a = 0; a < 3; ++a)
    if (!(unit.position[a] >= scene.lower[a] && unit.position[a] <= scene.upper[a]))
      refuse(text, "is outside the shop",
             fmt::format("the shop extends from {:g}, {:g}, {:g} to {:g}, {:g}, {:g}", scene.lower.x,
                         scene.lower.y, scene.lower.z, scene.upper.x, scene.upper.y, scene.upper.z));
}

}  // namespace

Transceiver given_unit(std::string_view text, const Scene& scene, std::string id) {
  const UnitFields fields = split(text, ',');
  Transceiver unit;
  unit.id = std::move(id);
  read(text, fields, 0, scene, unit);
  const bool has_type = !number_of(fields.back());
  if (!has_type) unit.type = common_type(text, scene);
  return unit;
}

MovedUnit moved_unit(std::string_view text, const Scene& scene) {
  const UnitFields fields = split(text, ',');
  const auto& units = scene.transceivers;
  const auto found =
      std::find_if(units.begin(), units.end(), [&](const Transceiver& unit) { return unit.id == fields[0]; });
  if (found == units.end())
    refuse(text, fmt::format("begins with {}, which is the id of no unit", in_quotes(fields[0])),
           "write ID,x,y,z, then the axis as three numbers and the type if they change");
  MovedUnit moved{found->id, *found};
  moved.unit.installed = moved.unit.pinned = moved.unit.selected = false;
  read(text, fields, 1, scene, moved.unit);
  return moved;
}

}  // namespace shelfbeam
