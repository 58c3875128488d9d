#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "serve/project/project.hpp"

namespace shelfbeam::serve {

// Parts of the events for pages (docs/formats/planner.md#events).

/// The text of a message. Bytes that are not UTF-8 are replaced.
std::string text_of(const nlohmann::ordered_json& json);

/// The name that a store gives itself, or else that of its folder.
std::string name_of_shop(const nlohmann::ordered_json& store, const std::string& folder);

/// The text of a message with the store, which is not copied, because it may be large.
std::string with_document(const nlohmann::ordered_json& message, const nlohmann::ordered_json& store);

/// Adds revision, history and lock of a project. `from`: the first of its steps, `all`, that the pages do not
/// know.
void add_state(nlohmann::ordered_json& json, const Project& project, const std::vector<Step>& all,
               std::size_t from = 0);

}  // namespace shelfbeam::serve
