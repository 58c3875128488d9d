#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "shelfbeam/base/finding/finding.hpp"

namespace shelfbeam {

/// The paths of elements of a store file, each with a code of warnings that it ignores.
using IgnoredCodes = std::set<std::pair<std::string, FindingCode>>;

/// Warnings by code. The first five of each code are kept, and the others are counted, because an error in
/// one fixture may affect thousands of labels.
class WarningList {
 public:
  WarningList(const std::string& file, const IgnoredCodes& ignored) : file_(file), ignored_(ignored) {}

  /// `where` is the location: "store.json: fixtures[3]". It is put before the text.
  template <class... Values>
  void add(FindingCode code, const std::string& where, fmt::format_string<const Values&...> text,
           const Values&... values) {
    add_text(code, where, fmt::format(text, values...), {value_of(values)...});
  }
  void add_text(FindingCode code, const std::string& where, const std::string& text, FindingValues values);
  void add(Finding warning);
  /// Codes in the order of their first appearance.
  std::vector<Finding> findings() const;
  /// The number of warnings that an element of the store, or the store itself, ignores.
  std::size_t ignored() const { return ignored_count_; }

 private:
  template <class Value>
  static FindingValue value_of(const Value& value) {
    if constexpr (std::is_arithmetic_v<Value>)
      return static_cast<double>(value);
    else
      return std::string(value);
  }
  std::string path_of(const std::string& where) const;
  bool is_ignored(FindingCode code, std::string path) const;

  static constexpr std::size_t shown = 5;
  struct Group {
    FindingCode code;
    std::vector<Finding> first;
    std::size_t count = 0;
  };
  const std::string& file_;
  const IgnoredCodes& ignored_;
  std::vector<Group> groups_;
  std::size_t ignored_count_ = 0;
};

}  // namespace shelfbeam
