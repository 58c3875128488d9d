#include "shelfbeam/scene/warning_list.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace shelfbeam {

// Without the name of the store file and without a note such as "(preset 'run')".
std::string WarningList::path_of(const std::string& where) const {
  std::string path = where.starts_with(file_ + ": ") ? where.substr(file_.size() + 2) : where;
  for (const char* note : {" (preset '", " (copy '"})
    if (const auto at = path.find(note); at != std::string::npos) path.resize(at);
  return path;
}

bool WarningList::is_ignored(FindingCode code, std::string path) const {
  while (!ignored_.empty() && !ignored_.contains({path, code})) {
    if (path.empty()) return false;
    const auto end = path.find_last_of(".[");
    path.resize(end == std::string::npos ? 0 : end);
  }
  return !ignored_.empty();
}

void WarningList::add_text(FindingCode code, const std::string& where, const std::string& text,
                           FindingValues values) {
  add({code, path_of(where), std::move(values), fmt::format("{}: {}", where, text)});
}

void WarningList::add(Finding warning) {
  if (!ignored_.empty() && is_ignored(warning.code, warning.path)) {
    ++ignored_count_;
    return;
  }
  auto group =
      std::find_if(groups_.begin(), groups_.end(), [&](const Group& g) { return g.code == warning.code; });
  if (group == groups_.end()) group = groups_.insert(group, Group{warning.code, {}, 0});
  if (++group->count <= shown) group->first.push_back(std::move(warning));
}

std::vector<Finding> WarningList::findings() const {
  std::vector<Finding> all;
  for (const Group& group : groups_) {
    all.insert(all.end(), group.first.begin(), group.first.end());
    if (group.count > shown)
      all.push_back({group.code,
                     "",
                     {static_cast<double>(group.count - shown)},
                     fmt::format("and {} more {}", group.count - shown, subject_of(group.code))});
  }
  return all;
}

}  // namespace shelfbeam
