#pragma once

#include <string>
#include <string_view>

namespace shelfbeam::test {

/// The room of a store file with a concave outline, a hole, zones of different and sloped ceilings, and inner
/// walls with a door and a window; its walls and ceilings are "white". The window has a pane of the material
/// `pane`, unless that is empty.
inline std::string l_shaped_room(std::string_view floor, std::string_view pane) {
  const std::string in_window = pane.empty() ? "" : ", \"pane\": \"" + std::string(pane) + "\"";
  return R"({
    "outline": [[0, 0], [12, 0], [12, 5], [20, 6], [20, 14], [0, 14]], "holes": [[[8, 8], [9, 8], [9, 9], [8, 9]]],
    "height": 3.2, "ceiling": "white", "walls": "white", "floor": ")" +
         std::string(floor) + R"(",
    "zones": [
      {"id": "low", "polygon": [[0, 9], [6, 9], [6, 14], [0, 14]], "height": 2.6},
      {"id": "sloped", "polygon": [[12, 5], [20, 6], [20, 10], [12, 10]],
       "height": [[12, 5, 2.8], [20, 6, 2.8], [12, 10, 3.9]]}],
    "inner_walls": [
      {"id": "W1", "from": [4, 0], "to": [4, 6], "thickness": 0.12,
       "openings": [{"at": 1, "width": 0.9, "top": 2.1},
                    {"at": 3, "width": 1, "bottom": 1, "top": 2)" +
         in_window + R"(}]},
      {"id": "W2", "from": [4, 6], "to": [1, 6], "thickness": 0.2, "height": 2.2},
      {"id": "W3", "from": [13, 12], "to": [20, 5.9], "thickness": 0.1, "height": 3}]})";
}

}  // namespace shelfbeam::test
