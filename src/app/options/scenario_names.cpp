#include "app/options/scenario_names.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace shelfbeam::app {

namespace {

using Path = std::filesystem::path;

/// The last `parts` of a path, or all of it.
std::string tail(const Path& path, std::ptrdiff_t parts) {
  const std::ptrdiff_t all = std::distance(path.begin(), path.end());
  Path result;
  for (auto part = std::next(path.begin(), all - std::min(all, parts)); part != path.end(); ++part)
    result /= *part;
  return result.string();
}

/// The shortest tail of paths[k] that no other path has; empty where there is none.
std::string distinct_tail(const std::vector<Path>& paths, std::size_t k) {
  std::ptrdiff_t most = 0;
  for (const Path& path : paths) most = std::max(most, std::distance(path.begin(), path.end()));
  for (std::ptrdiff_t parts = 1; parts <= most; ++parts) {
    std::string name = tail(paths[k], parts);
    const auto has_it = [&](const Path& other) { return tail(other, parts) == name; };
    if (std::count_if(paths.begin(), paths.end(), has_it) == 1) return name;
  }
  return {};
}

}  // namespace

std::vector<std::string> scenario_names(const std::vector<Path>& files) {
  std::vector<Path> whole, bare;
  for (const Path& file : files) {
    whole.push_back(file.lexically_normal());
    bare.push_back(whole.back().parent_path() / whole.back().stem());
  }
  std::vector<std::string> names;
  for (std::size_t k = 0; k < files.size(); ++k) {
    std::string name = distinct_tail(bare, k);
    if (name.empty()) name = distinct_tail(whole, k);
    names.push_back(name.empty() ? whole[k].stem().string() : name);
  }
  return names;
}

}  // namespace shelfbeam::app
