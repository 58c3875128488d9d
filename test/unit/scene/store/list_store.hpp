#pragma once

#include <filesystem>
#include <string>

#include "unit/scene/sample_store.hpp"

namespace shelfbeam::test {

/// A store with these fixtures in a room of 30 x 20 x 3 m.
inline Json store_with(const std::string& fixtures) {
  Json store = sample_store();
  store["fixtures"] = Json::parse(fixtures);
  store["room"]["size"] = {30, 20, 3};
  return store;
}

inline Store read(const Json& store, const std::filesystem::path& folder = {}) {
  return read_text(store.dump(), folder);
}

/// The values of the fixtures, without those that the two stores word differently.
inline std::string fixtures_of(const Store& store) {
  return Json::parse(resolved_store_json(store, make_scene(store)))["fixtures"].dump(1);
}

inline constexpr const char* run_of_shelves =
    R"("type": "gondola", "length": 1.33, "depth": 0.9, "height": 1.8, "material": "steel",
  "shelves": [0.4, 0.9], "faces": ["front"], "labels": {"type": "small", "spacing": 0.5})";

}  // namespace shelfbeam::test
