#pragma once

#include <cstddef>
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace shelfbeam::serve {

using Json = nlohmann::ordered_json;

/// Memory of a parsed store or message, bytes: a text of brackets takes forty times its size.
inline constexpr std::size_t max_document = 100'000'000;

/// Whether two values are equal as JSON: the order of keys does not matter, and 1 equals 1.0.
bool same_value(const Json& a, const Json& b);

/// The reason why a value cannot be written to a JSON text of which it is `level` brackets deep ("has a
/// number that is not finite"); empty if it can.
std::string value_problem(const Json& value, std::size_t level);

/// A number, a text, true, false or null as JSON. Numbers have as few digits as read back exactly.
std::string scalar_text(const Json& value);

}  // namespace shelfbeam::serve
