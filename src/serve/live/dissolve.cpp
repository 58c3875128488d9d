#include "serve/live/dissolve.hpp"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/length_unit.hpp"
#include "shelfbeam/scene/field_writer.hpp"
#include "shelfbeam/scene/fixture/fixture.hpp"

#include "serve/live/place.hpp"

namespace shelfbeam::serve {

namespace {

using Json = nlohmann::ordered_json;

// A resolved value in the unit of the file, without the rounding errors of sums and conversions.
Json in_unit(const Json& value, double factor) {
  constexpr double digits = 1e9;
  if (value.is_number()) return std::round(value.get<double>() / factor * digits) / digits;
  Json result = value;
  if (value.is_structured())
    for (auto& part : result) part = in_unit(part, factor);
  return result;
}

// A value of a preset with its lengths in another unit, in that of the file. `metres`: the resolved value, in
// which lengths are in m; only they differ.
Json converted(const Json& value, const Json& metres, LengthUnit unit, double factor) {
  constexpr double rounding = 1e-9;
  if (value.is_number() && metres.is_number()) {
    const double length = to_metres(value.get<double>(), unit);
    return std::abs(length - metres.get<double>()) <= rounding * std::abs(length) ? in_unit(metres, factor)
                                                                                  : value;
  }
  Json result = value;
  if (value.is_array() && metres.is_array() && value.size() == metres.size())
    for (std::size_t k = 0; k < value.size(); ++k) result[k] = converted(value[k], metres[k], unit, factor);
  if (value.is_object() && metres.is_object())
    for (auto& [key, part] : result.items())
      if (metres.contains(key)) part = converted(part, metres[key], unit, factor);
  return result;
}

}  // namespace

std::vector<EditOp> dissolved(const std::string& pointer, const Json& entry, const FixtureKeys& whole,
                              const Draft& draft) {
  const Json& completed = whole.json;
  const bool stands_against = completed.contains("against"), repeats = completed.contains("repeat");
  const bool is_of_preset =
      (stands_against && !entry.contains("against")) || (repeats && !entry.contains("repeat"));
  std::vector<Json> copies;
  const StoreLists lists{draft.store.materials, draft.store.label_types, draft.store.transceiver_types};
  for (const auto& [fixture, where] : draft.store.fixtures)
    if (entry_of(where, draft.store.file) == pointer) copies.push_back(resolved(fixture, lists));
  if (copies.empty() || !(stands_against || repeats))
    throw InputError(pointer, "has neither 'repeat' nor 'against', or has problems",
                     "choose another fixture");

  const double factor = to_metres(1, draft.store.unit);
  std::vector<EditOp> ops;
  const std::string list = pointer.substr(0, pointer.rfind('/') + 1);
  auto index = std::stoul(pointer.substr(list.size()));
  for (const Json& copy : copies) {
    Json fixture = is_of_preset ? completed : entry;
    if (is_of_preset) {
      fixture.erase("preset");
      for (const auto& [key, unit] : whole.units)
        if (fixture.contains(key) && copy.contains(key))
          fixture[key] = converted(fixture[key], copy[key], unit, factor);
    }
    fixture.erase("repeat");
    fixture.erase("against");
    fixture["id"] = copy["id"];
    for (const auto& [key, value] : copy.items()) {
      const bool is_place = key == "at" || key == "rotation_deg";
      if (key != "id" && (value != copies.front()[key] || (stands_against && is_place)))
        fixture[key] = in_unit(value, key == "rotation_deg" ? 1 : factor);
    }
    // The first copy takes the place of the entry, with its comments.
    const bool is_first = ops.empty();
    ops.push_back(
        {list + std::to_string(index++), is_first ? std::optional(entry) : std::nullopt, std::move(fixture)});
  }
  return ops;
}

}  // namespace shelfbeam::serve
