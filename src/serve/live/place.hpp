#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace shelfbeam::serve {

/// The JSON pointer of the element that a path of a finding names ("fixtures[3].labels.spacing"); of the
/// deepest one that exists. Empty for the whole store.
std::string pointer_of(std::string_view path, const nlohmann::ordered_json& store);

/// The path in a location ("store.json: fixtures[3]") in this file; nothing for locations in other files.
std::optional<std::string_view> path_in(std::string_view where, const std::string& file);

/// The end of the location of one of several copies.
std::string copy_note(const std::string& id);

/// The pointer of the entry of an element in the store file; empty for elements of other files. `where`: its
/// location in a Store, for messages; `file`: the name of the store file in it.
std::string entry_of(const std::string& where, const std::string& file);

}  // namespace shelfbeam::serve
