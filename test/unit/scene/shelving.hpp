#pragma once

#include <cmath>

#include "unit/scene/sample_store.hpp"

namespace shelfbeam::test {

/// One gondola without a room: 3.2 x 0.9 x 1.8 m, boards at 0.4, 1.0 and 1.5 m, labels 0.5 m apart; with
/// other keys.
inline Json gondola_store(const Json& keys = Json::object()) {
  Json store = R"({
    "materials": { "m": { "type": "lambertian", "reflectance": 0.5 } },
    "label_types": { "l": { "threshold": 0.01 } },
    "transceiver_types": { "t": { "emission": { "type": "sin2theta", "peak": 1 } } },
    "fixtures": [ { "type": "gondola", "id": "A", "at": [2, 1], "length": 3.2, "depth": 0.9, "height": 1.8,
                    "material": "m", "shelves": [0.4, 1.0, 1.5],
                    "labels": { "type": "l", "spacing": 0.5 } } ],
    "labels": [ { "id": "far", "position": [0, 0, 1], "normal": [1, 0, 0], "type": "l" } ],
    "transceivers": { "list": [ { "id": "T", "position": [0, 0, 3], "type": "t" } ] }
  })"_json;
  store["fixtures"][0].merge_patch(keys);
  return store;
}

/// The same with a freezer of 2 x 0.8 x 0.9 m.
inline Json freezer_store(const Json& keys = Json::object()) {
  Json store = gondola_store();
  store["fixtures"][0] = R"({ "type": "freezer", "id": "F", "at": [2, 1], "length": 2, "depth": 0.8,
    "height": 0.9, "material": "m", "labels": { "type": "l", "spacing": 0.4 } })"_json;
  store["fixtures"][0].merge_patch(keys);
  return store;
}

/// A point of the store in the coordinates of a fixture at (2, 1): along its length, along its depth, up.
inline Vec3 in_fixture(const Vec3& p, double rotation_deg) {
  const double turn = rotation_deg * std::acos(-1.0) / 180, c = std::cos(turn), s = std::sin(turn);
  const double x = p.x - 2, y = p.y - 1;
  return {c * x + s * y, -s * x + c * y, p.z};
}

}  // namespace shelfbeam::test
