#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam::test {

/// A room of 6 x 5 x 3 m with one gondola and a few labels and units, as a store file; tests vary its parts.
struct SmallStore {
  double albedo = 0.6;
  double stocking = 0.7;
  std::vector<double> peaks{1, 1, 1, 1};  ///< W/sr, one unit each
  std::vector<std::string> labels{
      R"({"id": "near", "position": [1.5, 1.0, 1.2], "normal": [0, -1, 0], "type": "standard"})",
      R"({"id": "floor", "position": [3.0, 3.5, 0.01], "normal": [0, 0, 1], "type": "standard"})",
      R"({"id": "wall", "position": [0.01, 2.5, 1.0], "normal": [1, 0, 0], "type": "standard"})",
      R"({"id": "tilted", "position": [5.0, 4.0, 1.4], "normal": [-0.6, 0, 0.8], "type": "standard"})"};

  std::string text() const {
    std::string types, units;
    for (std::size_t j = 0; j < peaks.size(); ++j) {
      const char* comma = j == 0 ? "" : ",\n";
      types += fmt::format(R"({}"unit{}": {{"emission": {{"type": "sin2theta", "peak": {}}}}})", comma, j,
                           peaks[j]);
      units += fmt::format(R"({}{{"id": "T{}", "position": [{}, {}, 2.98], "type": "unit{}"}})", comma, j,
                           1 + 1.3 * static_cast<double>(j % 4), 0.7 + 0.9 * static_cast<double>(j), j);
    }
    return fmt::format(R"({{
      "room": {{"size": [6, 5, 3], "floor": "paper", "ceiling": "paper", "walls": "paper"}},
      "materials": {{"paper": {{"type": "lambertian", "reflectance": {}}}}},
      "label_types": {{"standard": {{"threshold": 0.02}}}},
      "transceiver_types": {{{}}},
      "fixtures": [{{"type": "gondola", "id": "A1", "at": [1.2, 1.6], "length": 3, "depth": 0.8, "height": 1.6,
                    "material": "paper", "shelves": [0.5, 1.1], "stocking": {},
                    "labels": {{"type": "standard", "spacing": 1.0}}}}],
      "labels": [{}],
      "transceivers": {{"list": [{}]}}
    }})",
                       albedo, types, stocking, fmt::join(labels, ",\n"), units);
  }

  Scene scene() const { return make_scene(parse_store(text(), "small store", ".")); }
};

}  // namespace shelfbeam::test
