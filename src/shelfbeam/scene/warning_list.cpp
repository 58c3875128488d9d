#include "shelfbeam/scene/warning_list.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace shelfbeam {

namespace {

constexpr std::size_t shown = 5;

}  // namespace

void WarningList::add(std::string_view kind, const std::string& warning) {
  auto group = std::find_if(groups_.begin(), groups_.end(), [&](const Group& g) { return g.kind == kind; });
  if (group == groups_.end()) group = groups_.insert(group, Group{std::string(kind), {}, 0});
  if (++group->count <= shown) group->first.push_back(warning);
}

std::vector<std::string> WarningList::texts() const {
  std::vector<std::string> texts;
  for (const Group& group : groups_) {
    texts.insert(texts.end(), group.first.begin(), group.first.end());
    if (group.count > shown) texts.push_back(fmt::format("and {} more {}", group.count - shown, group.kind));
  }
  return texts;
}

}  // namespace shelfbeam
