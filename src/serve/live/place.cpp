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

// The number in "[17]" at the beginning of a path, and the rest.
std::optional<std::size_t> take_index(std::string_view& path) {
  const std::size_t end = path.find(']');
  if (!path.starts_with('[') || end == std::string_view::npos) return {};
  const auto index = to_whole_number(path.substr(1, end - 1), UINT32_MAX);
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
  Json::json_pointer pointer;
  const Json* here = &store;
  while (!path.empty()) {
    if (path.starts_with('.')) path.remove_prefix(1);
    if (here->is_array()) {
      const auto index = take_index(path);
      if (!index || *index >= here->size()) break;
      pointer /= *index;
      here = &(*here)[*index];
    } else {
      const std::string* const key = here->is_object() ? longest_key(*here, path) : nullptr;
      if (key == nullptr) break;
      pointer /= *key;
      path.remove_prefix(key->size());
      here = &here->at(*key);
    }
  }
  return pointer.to_string();
}

std::optional<std::string_view> path_in(std::string_view where, const std::string& file) {
  if (!where.starts_with(file) || !where.substr(file.size()).starts_with(": ")) return {};
  return where.substr(file.size() + 2);
}

std::string copy_note(const std::string& id) {
  constexpr std::size_t longest = 60;  // as in the reader of stores
  return fmt::format(" (copy {})", in_quotes(shortened(id, longest)));
}

std::string entry_of(const std::string& where, const std::string& file) {
  const auto path = path_in(where, file);
  if (!path) return {};
  std::string pointer = "/";
  for (const char c : path->substr(0, path->find(" (")))  // without notes about presets and copies
    if (c == '[' || c == '.')
      pointer += '/';
    else if (c != ']')
      pointer += c;
  return pointer;
}

}  // namespace shelfbeam::serve
