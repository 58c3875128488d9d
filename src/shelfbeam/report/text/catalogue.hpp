#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"

namespace shelfbeam {

/// The text with this key in english.json, which contains all texts of the report. A translation is another
/// such file. Keys are paths ("mounting.title"). Throws std::logic_error for a key that is missing.
std::string_view words(std::string_view key);

/// Fills the places {0}, {1}, ... of a text.
template <class... Args>
std::string say(std::string_view key, const Args&... args) {
  return fmt::format(fmt::runtime(words(key)), args...);
}

/// The text with the key `key`.one for a count of 1, otherwise `key`.many; {0} is the count.
template <class... Args>
std::string say_count(std::string_view key, std::uint64_t count, const Args&... args) {
  return say(fmt::format("{}.{}", key, count == 1 ? "one" : "many"), grouped(count), args...);
}

}  // namespace shelfbeam
