#pragma once

#include <cmath>
#include <regex>
#include <string>

#include "shelfbeam/scene/build/decisive_values.hpp"

#include "support/l_shaped_room.hpp"
#include "unit/scene/sample_store.hpp"

namespace shelfbeam::test {

/// The sample with every length replaced by `change` of it. `at_m` has its unit in its name.
template <class Change>
Json with_lengths(const Change& change) {
  static const std::regex length(
      "/(size|thickness|radius|at|length|depth|height|shelves|min|max|spacing|vertices|position|z)(/"
      "[0-9]+)*$");
  Json values = sample_store().flatten();
  for (const auto& [pointer, value] : values.items())
    if (value.is_number() && std::regex_search(pointer, length)) value = change(value.template get<double>());
  return values.unflatten();
}

/// The double nearest to the decimal number.
inline double decimal(double value) {
  return std::round(value * 1e7) / 1e7;
}

inline Json sample_in_mm() {
  Json store = with_lengths([](double metres) { return decimal(metres * 1000); });
  store["units"] = "mm";
  return store;
}

/// The shop with which the planner begins, and a gondola of its catalogue.
inline Json new_shop() {
  Json store = Json::parse(starter_store(), nullptr, true, true);
  const Json catalogue = Json::parse(starter_catalogue(), nullptr, true, true);
  store.erase("catalogues");
  store["materials"].update(catalogue["materials"]);
  store["presets"] = catalogue["presets"];
  store["fixtures"] = R"([{"preset": "gondola 1.25 m, double, 1.6 m high", "id": "A{n}", "at": [2, 2],
                           "repeat": {"count": 12, "step": 1.25}}])"_json;
  return store;
}

/// A room in the shape of an L with a lower zone, an inner wall and a column.
inline Json zoned_store(const Json& transceivers) {
  Json store = store_of_room(R"({
    "outline": [[0, 0], [8, 0], [8, 4], [4, 4], [4, 10], [0, 10]], "height": 3.2, "floor": "tile", "ceiling": "white",
    "walls": "white",
    "zones": [{"id": "low", "polygon": [[0, 6], [4, 6], [4, 10], [0, 10]], "height": 2.6}],
    "inner_walls": [{"id": "W", "from": [6, 0], "to": [6, 2], "thickness": 0.6}]})");
  store["fixtures"] = R"([{"type": "cylinder", "id": "C", "at": [2, 3], "radius": 0.25, "top": "ceiling",
                           "material": "white"}])"_json;
  store["transceivers"] = transceivers;
  return store;
}

/// A shop in an L-shaped room, with shelves, a cabinet, a counter, people and pallets.
inline Json changing_shop() {
  Json store = store_of_room(l_shaped_room("tile", ""));
  store["room"].update(R"({"height": 3,
    "zones": [{"id": "low", "polygon": [[12, 5], [20, 6], [20, 10], [12, 10]], "height": 1.7}],
    "inner_walls": [{"id": "W", "from": [4, 0], "to": [4, 6], "openings": [{"at": 1, "width": 2, "top": 2.1}]}]})"_json);
  store["fixtures"] = R"([
    {"type": "gondola", "id": "A", "at": [6, 2], "length": 3, "depth": 0.9, "height": 1.8, "rotation_deg": 20,
     "material": "steel", "shelves": [0.4, 0.9, 1.3], "labels": {"type": "small", "count": 2}},
    {"type": "gondola", "id": "chiller", "at": [1, 12.9], "length": 3, "depth": 0.9, "height": 1.8, "faces": ["front"],
     "material": "steel", "shelves": [0.4], "doors": "door", "variation": {"stocking": 0.7}},
    {"type": "freezer", "id": "F", "at": [1, 8], "length": 2, "depth": 0.8, "height": 0.9, "material": "steel"},
    {"type": "prism", "id": "counter", "polygon": [[10, 10], [13, 10], [13, 13], [12, 11]], "top": 1,
     "material": "white"}])"_json;
  store["labels"] = Json::array();
  store["transceivers"] = R"({"areas": [{"type": "down", "area": "room", "spacing": 3, "below_ceiling": 0.02,
    "axes": [[0, 0, -1], [0.5, 0, -0.8]]}], "keep_out": [{"min": [0, 0], "max": [3, 3]}], "installed": ["A1-2-3/a1"]})"_json;
  store["variation"] = R"({"stocking": {"uniform": [0.4, 0.9]}, "correlation": 0.6,
    "people": [{"area": "room", "number": {"poisson": 4}, "size": [0.5, 0.3, 1.75], "material": "carton"}],
    "doors": [{"fixtures": "chill*", "open": 0.25}],
    "objects": [{"id": "pallet", "present": 0.3, "area": [[9, 1], [12, 1], [12, 5], [9, 5]], "size": [1.2, 0.8, 1.4],
                 "material": "carton"}],
    "mounting": {"position": 0.05, "tilt_deg": 2}, "unit_power_db": 0.5, "label_sensitivity_db": 1})"_json;
  return store;
}

}  // namespace shelfbeam::test
