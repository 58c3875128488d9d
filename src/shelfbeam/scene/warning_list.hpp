#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace shelfbeam {

/// Warnings by kind. Of each kind the first five are told in full, the others as a number: a slip in one
/// fixture may concern thousands of labels.
class WarningList {
 public:
  /// `kind` is what "and 123 more" counts: "labels that lie inside a fixture".
  void add(std::string_view kind, const std::string& warning);
  /// Kinds in the order in which they first came.
  std::vector<std::string> texts() const;

 private:
  struct Group {
    std::string kind;
    std::vector<std::string> first;
    std::size_t count = 0;
  };
  std::vector<Group> groups_;
};

}  // namespace shelfbeam
