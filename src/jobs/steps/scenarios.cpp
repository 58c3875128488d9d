#include "jobs/steps/scenarios.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

#include "shelfbeam/signal/constraints/stack_tables.hpp"

namespace shelfbeam::jobs {

namespace {

using Path = std::filesystem::path;

/// The last `parts` components of a path, or the whole path.
std::string tail(const Path& path, std::ptrdiff_t parts) {
  const std::ptrdiff_t all = std::distance(path.begin(), path.end());
  Path result;
  for (auto part = std::next(path.begin(), all - std::min(all, parts)); part != path.end(); ++part)
    result /= *part;
  return result.string();
}

/// The shortest tail of paths[k] that no other path has; empty if every tail is shared.
std::string distinct_tail(const std::vector<Path>& paths, std::size_t k) {
  std::ptrdiff_t max_parts = 0;
  for (const Path& path : paths) max_parts = std::max(max_parts, std::distance(path.begin(), path.end()));
  for (std::ptrdiff_t parts = 1; parts <= max_parts; ++parts) {
    std::string name = tail(paths[k], parts);
    const auto has_it = [&](const Path& other) { return tail(other, parts) == name; };
    if (std::count_if(paths.begin(), paths.end(), has_it) == 1) return name;
  }
  return {};
}

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

}  // namespace

std::string names_of_files(const std::vector<Path>& files) {
  std::string names;
  for (const Path& file : files) names += (names.empty() ? "" : ", ") + file.string();
  return names;
}

ReadTable read_scenarios(const std::vector<Path>& files, TableReading reading) {
  const std::vector<std::string> names = scenario_names(files);
  std::vector<NamedTable> scenarios;
  std::vector<Finding> warnings;
  for (std::size_t k = 0; k < files.size(); ++k) {
    ReadTable read = read_table(files[k], reading);
    scenarios.push_back({names[k], files[k].string(), std::move(read.table)});
    warnings.insert(warnings.end(), read.warnings.begin(), read.warnings.end());
  }
  return {stack_tables(std::move(scenarios)), std::move(warnings)};
}

}  // namespace shelfbeam::jobs
