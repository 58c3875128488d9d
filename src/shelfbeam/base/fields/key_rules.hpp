#pragma once

#include <functional>
#include <initializer_list>
#include <string_view>

namespace shelfbeam {

/// Collects problems of rules that tie the keys of an object together.
class KeyRules {
 public:
  virtual ~KeyRules() = default;
  /// Collects the InputError of `check`, unless one of the keys ("size") or of the members of lists
  /// ("zones[2]") has a problem itself. Returns whether the rule was checked and holds.
  virtual bool rule(std::initializer_list<std::string_view> keys, const std::function<void()>& check) = 0;
};

}  // namespace shelfbeam
