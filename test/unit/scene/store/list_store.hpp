#pragma once

#include <gtest/gtest.h>

#include "unit/scene/sample_store.hpp"

namespace shelfbeam::test {

/// The values of the fixtures, without those that two stores word differently.
inline Json fixtures_of(const Store& store) {
  return Json::parse(resolved_store_json(store, make_scene(store)))["fixtures"];
}

/// A gondola of 1.33 x 0.9 x 1.8 m with boards at its front, and with other keys.
inline Json shelves(const Json& keys = Json::object()) {
  Json gondola = R"({"type": "gondola", "length": 1.33, "depth": 0.9, "height": 1.8, "material": "steel",
    "shelves": [0.4, 0.9], "faces": ["front"], "labels": {"type": "small", "spacing": 0.5}})"_json;
  gondola.merge_patch(keys);
  return gondola;
}

/// A store with a gondola "A" of 3 m and a planogram p.csv, without other labels.
inline Json planogram_store(const Json& more = Json::object()) {
  Json store = store_with(shelves({{"id", "A"}, {"at", {5, 5}}, {"length", 3}, {"labels", nullptr}}));
  store["labels"] = Json::array();
  store["planogram"] = {{"file", "p.csv"}, {"type", "small"}};
  store["planogram"].update(more);
  return store;
}

/// Expects a place of a label, within rounding.
inline void expect_place(const Label& label, LabelPlace known) {
  EXPECT_NEAR(label.place.along, known.along, 1e-9) << label.id;
  known.along = label.place.along;
  EXPECT_EQ(label.place, known) << label.id;
}

}  // namespace shelfbeam::test
