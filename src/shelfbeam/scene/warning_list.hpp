#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace shelfbeam {

/// Warnings by kind. The first five of each kind are printed in full, and the others are counted, because an
/// error in one fixture may affect thousands of labels.
class WarningList {
 public:
  /// `kind` completes the line "and 123 more ...", for example "labels inside a fixture".
  void add(std::string_view kind, const std::string& warning) {
    auto group = std::find_if(groups_.begin(), groups_.end(), [&](const Group& g) { return g.kind == kind; });
    if (group == groups_.end()) group = groups_.insert(group, Group{std::string(kind), {}, 0});
    if (++group->count <= shown) group->first.push_back(warning);
  }
  /// The warnings, with kinds in the order of their first appearance.
  std::vector<std::string> texts() const {
    std::vector<std::string> texts;
    for (const Group& group : groups_) {
      texts.insert(texts.end(), group.first.begin(), group.first.end());
      if (group.count > shown)
        texts.push_back("and " + std::to_string(group.count - shown) + " more " + group.kind);
    }
    return texts;
  }

 private:
  static constexpr std::size_t shown = 5;
  struct Group {
    std::string kind;
    std::vector<std::string> first;
    std::size_t count = 0;
  };
  std::vector<Group> groups_;
};

}  // namespace shelfbeam
