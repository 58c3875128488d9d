#pragma once

#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "shelfbeam/scene/build/draft.hpp"

#include "serve/live/parts.hpp"

namespace shelfbeam::serve {

/// The outlines of elements of `store` that have none in `parts` because of their problems: those that they
/// had `before`, in `store_before`, or else squares at the places of fixtures. At most 1000.
std::vector<Part> vanished_parts(const std::vector<Part>& parts, const std::vector<Part>& before,
                                 const nlohmann::ordered_json& store_before, const Draft& draft,
                                 const nlohmann::ordered_json& store);

}  // namespace shelfbeam::serve
