#include "app/batch/store_list.hpp"

#include <algorithm>
#include <map>
#include <sstream>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/text.hpp"

#include "app/plan_folder.hpp"

namespace shelfbeam::app {
namespace fs = std::filesystem;

namespace {

// "north/12/store.json" -> "north/12", "north/12.json" -> "north/12"
std::string name_of(const fs::path& file) {
  fs::path relative;
  for (const fs::path& step : file.lexically_normal().relative_path())
    if (step != "..") relative /= step;
  if (relative.filename() == store_name && relative.has_parent_path()) return relative.parent_path().string();
  return relative.replace_extension().string();
}

std::string without_blanks(std::string_view line) {
  constexpr std::string_view blank = " \t\r";
  const auto first = line.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return std::string(line.substr(first, line.find_last_not_of(blank) + 1 - first));
}

std::vector<ListedStore> from_list(const fs::path& list) {
  std::vector<ListedStore> stores;
  std::istringstream lines(read_file(list));
  for (std::string line; std::getline(lines, line);) {
    const std::string path = without_blanks(line);
    if (path.empty() || path.starts_with('#')) continue;
    stores.push_back({name_of(path), list.parent_path() / path});
  }
  return stores;
}

[[noreturn]] void cannot_read(const fs::path& folder, const std::error_code& error) {
  throw InputError(folder.string(), fmt::format("cannot be read ({})", error.message()),
                   "check its permissions");
}

std::vector<ListedStore> from_folder(const fs::path& folder, const fs::path& results) {
  std::vector<ListedStore> stores, others;
  std::error_code error;
  fs::recursive_directory_iterator entry(folder, error), end;
  for (; !error && entry != end; entry.increment(error)) {
    std::error_code missing;
    const bool is_folder = entry->is_directory(missing);
    if (is_folder && (fs::exists(entry->path() / placement_name, missing) ||
                      fs::equivalent(entry->path(), results, missing))) {
      entry.disable_recursion_pending();
      continue;
    }
    if (is_folder || entry->path().extension() != ".json") continue;
    const ListedStore store{name_of(fs::relative(entry->path(), folder)), entry->path()};
    if (entry->path().filename() == store_name) stores.push_back(store);
    if (entry.depth() == 0) others.push_back(store);
  }
  if (error) cannot_read(folder, error);
  return stores.empty() ? others : stores;
}

}  // namespace

std::vector<ListedStore> listed_stores(const fs::path& source, const fs::path& results) {
  std::error_code missing;
  auto stores = fs::is_directory(source, missing) ? from_folder(source, results) : from_list(source);
  if (stores.empty())
    throw InputError(source.string(), "names no store", "list the paths of store files, one per line");
  std::sort(stores.begin(), stores.end(),
            [](const ListedStore& a, const ListedStore& b) { return a.name < b.name; });
  std::map<fs::path, std::string> listed;
  for (std::size_t k = 0; k < stores.size(); ++k) {
    const std::string file = stores[k].file.string();
    if (stores[k].name.empty())
      throw InputError(source.string(), fmt::format("{} is not the path of a store file", in_quotes(file)));
    const auto [other, is_new] = listed.emplace(fs::weakly_canonical(stores[k].file, missing), file);
    if (!is_new)
      throw InputError(source.string(), fmt::format("lists the store {} twice", in_quotes(other->second)),
                       "list each store once");
    if (k > 0 && stores[k].name == stores[k - 1].name)
      throw InputError(
          source.string(),
          fmt::format("gives the stores {} and {} the same name {}", in_quotes(stores[k - 1].file.string()),
                      in_quotes(file), in_quotes(stores[k].name)),
          "list them by paths that differ in more than '..'");
  }
  return stores;
}

}  // namespace shelfbeam::app
