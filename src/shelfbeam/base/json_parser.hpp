#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace shelfbeam {

/// The longest part of a key in messages, bytes.
inline constexpr std::size_t longest_key = 60;

/// The most brackets within one another. It is deeper than any valid file; the limit is needed because a
/// level costs much more memory than its bracket.
inline constexpr std::size_t max_json_levels = 100;

/// Parses a JSON document in UTF-8, with or without a byte order mark. Comments and a comma behind the last
/// element of a list or an object are allowed, as editors of JSON with comments allow them; duplicate keys
/// are not. Throws InputError, which names the file as `name`, with the line; and before the document takes
/// more than `memory` bytes (0: 80 % of the memory that this process may use).
nlohmann::ordered_json parse_json(std::string_view text, const std::string& name, std::size_t memory = 0);

}  // namespace shelfbeam
