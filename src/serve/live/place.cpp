#include "serve/live/place.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/text.hpp"

namespace shelfbeam::serve {

namespace {

using Json = nlohmann::ordered_json;

std::string escaped(std::string_view key) {
  std::string text;
  for (const char c : key) text += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  return text;
}

// The number in "[17]" at the beginning of a path, and the rest.
std::optional<std::size_t> take_index(std::string_view& path) {
  const std::size_t end = path.find(']');
  if (!path.starts_with('[') || end == std::string_view::npos) return {};
  std::size_t index = 0;
  for (const char c : path.substr(1, end - 1)) {
    if (c < '0' || c > '9' || index > UINT32_MAX) return {};
    index = 10 * index + static_cast<std::size_t>(c - '0');
  }
  path.remove_prefix(end + 1);
  return index;
}

// The longest key of an object with which a path begins: keys may contain dots.
const std::string* longest_key(const Json& object, std::string_view path) {
  const std::string* longest = nullptr;
  for (const auto& [key, value] : object.items()) {
    const bool fits = path.starts_with(key) &&
                      (path.size() == key.size() || path[key.size()] == '.' || path[key.size()] == '[');
    if (fits && (longest == nullptr || key.size() > longest->size())) longest = &key;
  }
  return longest;
}

}  // namespace

std::string pointer_of(std::string_view path, const Json& store) {
  std::string pointer;
  const Json* here = &store;
  while (!path.empty()) {
    if (path.starts_with('.')) path.remove_prefix(1);
    if (here->is_array()) {
      const auto index = take_index(path);
      if (!index || *index >= here->size()) break;
      pointer += "/" + std::to_string(*index);
      here = &(*here)[*index];
    } else {
      const std::string* const key = here->is_object() ? longest_key(*here, path) : nullptr;
      if (key == nullptr) break;
      pointer += "/" + escaped(*key);
      path.remove_prefix(key->size());
      here = &here->at(*key);
    }
  }
  return pointer;
}

std::string copy_note(const std::string& id) {
  constexpr std::size_t longest = 60;  // as in the reader of stores
  return fmt::format(" (copy {})", in_quotes(shortened(id, longest)));
}

std::string entry_of(const std::string& where, const std::string& file) {
  std::string_view path = where;
  if (!path.starts_with(file) || !path.substr(file.size()).starts_with(": ")) return {};
  path.remove_prefix(file.size() + 2);
  path = path.substr(0, path.find(" ("));  // notes about presets and copies
  std::string pointer = "/";
  for (const char c : path)
    if (c == '[' || c == '.')
      pointer += '/';
    else if (c != ']')
      pointer += c;
  return pointer;
}

}  // namespace shelfbeam::serve
