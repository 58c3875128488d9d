#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam::test {

using Json = nlohmann::ordered_json;

inline Json operator""_json(const char* text, std::size_t size) {
  return Json::parse(text, text + size);
}

/// A small store with something in every section.
inline Json sample_store() {
  return R"({
    "$schema": "../data/store.schema.json",
    "name": "Sample",
    "wavelength_nm": 950,
    "room": { "size": [8, 6, 3], "floor": "tile", "ceiling": "white",
              "walls": { "x0": "white", "x1": "white", "y0": "white", "y1": "tile" } },
    "materials": { "white": { "type": "lambertian", "reflectance": 0.8 },
                   "tile": { "type": "lambertian", "reflectance": 0.5 },
                   "steel": { "type": "lambertian", "reflectance": 0 },
                   "snow": { "type": "lambertian", "reflectance": 0.97 },
                   "foil": { "type": "conductor", "eta": 1.674, "k": 8.608 },
                   "chrome": { "type": "conductor", "eta": 3.357, "k": 3.546, "roughness": [0.2, 0.4],
                               "distribution": "beckmann", "masking": "smith_rational", "sampling": "all" },
                   "carton": { "type": "plastic", "ior": 1.5, "reflectance": 0.6 },
                   "jar": { "type": "dielectric", "ior": 1.5, "roughness": 0.1 },
                   "door": { "type": "thin_dielectric", "ior": 1.515, "thickness": 0.006,
                             "absorption_per_m": 54.6 } },
    "label_types": {
      "small": { "responsivity": { "type": "cosine" }, "size": [0, 0], "threshold": 0.02,
                 "safety_factor": 1.5, "link_cost": 0.25, "signal_cost": 3 },
      "large": { "threshold": 0.01 },
      "deep": { "responsivity": { "type": "cosine_power", "exponent": 2.5, "cutoff_deg": 60 },
                "size": [0.2, 0.1], "threshold": { "hears": "down", "at_m": 5, "angle_deg": 45 } },
      "measured": { "responsivity": { "type": "table", "theta_deg": [0, 40, 75], "response": [2, 1.5, 0] },
                    "threshold": { "hears": "fan", "at_m": 2 } } },
    "transceiver_types": {
      "down": { "emission": { "type": "sin2theta", "peak": 2 }, "radius": 0, "cost": 4 },
      "wide": { "emission": { "type": "isotropic", "intensity": 0.5 } },
      "spot": { "emission": { "type": "lambertian", "order": 20, "flux": 3 } },
      "disc": { "emission": { "type": "lambertian", "flux": 3 }, "radius": 0.2 },
      "ring": { "emission": { "type": "table", "theta_deg": [0, 30, 90], "intensity": [0, 1, 0] } },
      "fan": { "emission": { "type": "table", "theta_deg": [0, 45, 120], "phi_deg": [0, 90, 200],
                             "intensity": [[1, 2, 3], [4, 5, 6], [7, 8, 9]] } } },
    "fixtures": [
      { "type": "gondola", "id": "A", "at": [2, 1], "length": 3, "depth": 0.9, "height": 1.8,
        "rotation_deg": 15, "material": "steel", "goods": "tile", "shelves": [0.4, 1.0, 1.5],
        "stocking": 0.6, "faces": ["front", "back"],
        "labels": { "type": "small", "spacing": 0.5, "faces": ["back"], "tilt_deg": 10 } },
      { "type": "freezer", "id": "F", "at": [1, 4], "length": 2, "depth": 0.8, "height": 0.9,
        "rotation_deg": 0, "material": "steel", "goods": "snow", "stocking": 1,
        "labels": { "type": "large", "spacing": 0.4, "faces": ["left", "front"], "tilt_deg": 0 } },
      { "type": "box", "id": "C", "min": [7, 0, 0], "max": [7.5, 0.5, 3], "material": "white" },
      { "type": "mesh", "id": "M", "at": [6, 4, 0.5], "rotation_deg": -90, "scale": 0.5, "parts": [
        { "name": "roof", "material": "white", "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
          "faces": [[0, 1, 2], [0, 1, 3]] } ] } ],
    "labels": [ { "id": "L1", "position": [5, 2, 1], "normal": [0, 0, 2], "type": "large" } ],
    "transceivers": {
      "grids": [ { "type": "down", "min": [1, 1], "max": [7, 5], "spacing": 2, "z": 2.9,
                   "axis": [0, 0, -1], "roll_deg": 0 } ],
      "list": [ { "id": "T1", "position": [4, 3, 2.8], "axis": [0, 1, -1], "roll_deg": 30, "type": "fan" },
                { "id": "T2", "position": [1, 3, 2.8], "type": "ring" } ],
      "keep_out": [ { "min": [0, 0], "max": [1.5, 1.5] } ],
      "installed": [ "T1" ] }
  })"_json;
}

/// The sample with one value replaced; `pointer` is a JSON pointer, and an empty text removes the value.
inline Json changed_store(const std::string& pointer, const std::string& value) {
  Json store = sample_store();
  const Json::json_pointer at(pointer);
  if (!value.empty()) {
    store[at] = Json::parse(value);
  } else if (Json& parent = store[at.parent_pointer()]; parent.is_array()) {
    parent.erase(std::stoul(at.back()));
  } else {
    parent.erase(at.back());
  }
  return store;
}

inline Store read_text(const std::string& text, const std::filesystem::path& folder = {}) {
  return parse_store(text, "store.json", folder);
}

inline Store read(const Json& store, const std::filesystem::path& folder = {}) {
  return read_text(store.dump(), folder);
}

inline Scene scene_of(const Json& store, const std::filesystem::path& folder = {}) {
  return make_scene(read(store, folder));
}

/// The warnings of a scene, as text.
inline std::vector<std::string> warnings_of(const Json& store, const std::filesystem::path& folder = {}) {
  return sentences(scene_of(store, folder).warnings);
}

/// The sample with this fixture, or these, in a room of 30 x 20 x 3 m.
inline Json store_with(const Json& fixtures) {
  Json store = sample_store();
  store["fixtures"] = fixtures.is_array() ? fixtures : Json::array({fixtures});
  store["room"]["size"] = {30, 20, 3};
  return store;
}

/// A store with this room, without fixtures, and with one label and one candidate near its first corner.
inline Json store_of_room(const std::string& room) {
  Json store = sample_store();
  store["room"] = Json::parse(room);
  store["fixtures"] = Json::array();
  store["labels"] = R"([{"id": "L", "position": [1, 1, 1], "normal": [1, 0, 0], "type": "small"}])"_json;
  store["transceivers"] = R"({"list": [{"id": "T", "position": [1, 1, 2], "type": "down"}]})"_json;
  return store;
}

/// The member of a list with this id.
template <class List>
const auto& by_id(const List& list, std::string_view id) {
  return *std::find_if(list.begin(), list.end(), [&](const auto& one) { return one.id == id; });
}

/// All ids of a list, with a blank behind each.
template <class List>
std::string ids_of(const List& list) {
  std::string ids;
  for (const auto& one : list) ids += one.id + " ";
  return ids;
}

}  // namespace shelfbeam::test
