#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "shelfbeam/scene/build/draft.hpp"

namespace shelfbeam::serve {

/// The outline of an element for the plan (docs/formats/planner.md).
struct Part {
  std::string key;  ///< unique in the store
  nlohmann::ordered_json json;

  bool operator==(const Part&) const = default;
};

/// The elements of a store that have outlines; `store` is its file.
std::vector<Part> parts_of(const Draft& draft, const nlohmann::ordered_json& store);

}  // namespace shelfbeam::serve
