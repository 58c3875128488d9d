#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "shelfbeam/base/fields/fields.hpp"
#include "shelfbeam/base/names.hpp"

namespace shelfbeam {

/// One of the names of an enumeration; `names` may be limited to some of them.
template <class Enum>
bool describe_choice(Fields& f, std::string_view key, Enum& value, std::span<const Named<Enum>> names,
                     const Field& field) {
  std::vector<std::string_view> known, chosen{to_text(value)};
  for (const Named<Enum>& one : names) known.push_back(one.name);
  if (!f.choices(key, chosen, known, true, field)) return false;
  value = *from_text<Enum>(chosen.front());
  return true;
}

}  // namespace shelfbeam
