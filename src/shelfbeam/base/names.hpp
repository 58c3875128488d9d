#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace shelfbeam {

/// The name of an enumerator in files and on the command line.
template <class Enum>
struct Named {
  std::string_view name;
  Enum value;
};

/// The table of an enumeration's names; specialised for every enumeration that has names.
template <class Enum>
inline constexpr auto names_of = nullptr;

/// Empty for a value without a name.
template <class Enum>
constexpr std::string_view to_text(Enum value) {
  for (const auto& entry : names_of<Enum>)
    if (entry.value == value) return entry.name;
  return {};
}

template <class Enum>
constexpr std::optional<Enum> from_text(std::string_view name) {
  for (const auto& entry : names_of<Enum>)
    if (entry.name == name) return entry.value;
  return {};
}

template <class Enum>
std::vector<std::string> all_names() {
  std::vector<std::string> names;
  names.reserve(names_of<Enum>.size());
  for (const auto& entry : names_of<Enum>) names.emplace_back(entry.name);
  return names;
}

}  // namespace shelfbeam
