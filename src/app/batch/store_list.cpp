#include "app/batch/store_list.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/base/text.hpp"

#include "app/batch/own_files.hpp"
#include "app/batch/record.hpp"
#include "jobs/plan_folder.hpp"

namespace shelfbeam::app {

using namespace jobs;
namespace fs = std::filesystem;

namespace {

bool is_control(char c) {
  return (static_cast<unsigned char>(c) < 0x20) || c == 0x7f;
}

// Names appear in tables, pages and messages.
std::string readable(const std::string& text) {
  const bool is_text = is_utf8(text) && std::none_of(text.begin(), text.end(), is_control);
  return is_text ? text : printable(text);
}

// "north/12/store.json" -> "north/12", "north/12.json" -> "north/12"
std::string name_of(const fs::path& file) {
  fs::path relative;
  for (const fs::path& step : file.lexically_normal().relative_path())
    if (!step.empty() && step != "." && step != "..") relative /= step;
  if (relative.filename() == store_name && relative.has_parent_path())
    return readable(relative.parent_path().string());
  return readable(relative.replace_extension().string());
}

// The path in a line, which may be in quotes and have backslashes, as Windows writes it. No file has a null
// character in its path: the system would read another, shorter path.
std::string path_in(std::string_view line, const fs::path& folder) {
  std::string text = line.find('\0') == std::string_view::npos ? std::string(line) : printable(line);
  std::error_code missing;
  if (fs::exists(folder / text, missing)) return text;
  if (text.size() > 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  std::string with_slashes = text;
  std::replace(with_slashes.begin(), with_slashes.end(), '\\', '/');
  return fs::exists(folder / with_slashes, missing) ? with_slashes : text;
}

StoreList from_list(const fs::path& list) {
  StoreList found;
  std::set<fs::path> known;
  const std::string content = read_text(list);
  std::string_view text = content;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::string_view line = trim(take_line(text));
    if (line.empty() || line.starts_with('#')) continue;
    const std::string path = path_in(line, list.parent_path());
    const fs::path file = list.parent_path() / path;
    if (!known.insert(fs::absolute(file).lexically_normal()).second) {
      found.remarks.push_back(fmt::format("{}: line {}: lists the store {} again; it is planned once",
                                          list.string(), number, in_quotes(line)));
      continue;
    }
    std::string name = name_of(path);
    if (name.empty()) name = fmt::format("line {}", number);
    found.stores.push_back({std::move(name), file});
  }
  return found;
}

// Collects the stores of a tree of folders.
class Tree {
 public:
  Tree(fs::path root, const fs::path& results) : root_(std::move(root)), results_(results) {
    std::vector<fs::path> waiting{fs::path()};  // relative to the root
    while (!waiting.empty()) {
      const fs::path folder = std::move(waiting.back());
      waiting.pop_back();
      look(folder, waiting);
    }
  }

  std::vector<ListedStore> stores() && {
    std::vector<ListedStore> all = std::move(stores_.empty() ? others_ : stores_);
    std::move(unreadable_.begin(), unreadable_.end(), std::back_inserter(all));
    std::sort(all.begin(), all.end(),
              [](const ListedStore& a, const ListedStore& b) { return a.file.native() < b.file.native(); });
    return all;
  }

 private:
  void look(const fs::path& folder, std::vector<fs::path>& waiting) {
    std::error_code error;
    fs::directory_iterator entry(root_ / folder, error);
    for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
      const fs::path relative = folder / entry->path().filename();
      std::error_code missing;
      if (entry->is_symlink(missing) && entry->is_directory(missing)) {
        if (fs::exists(fs::symlink_status(entry->path() / store_name, missing)))
          add(stores_, relative / store_name);
      } else if (entry->is_directory(missing)) {
        if (!is_output(entry->path())) waiting.push_back(relative);
      } else if (relative.filename() == store_name) {
        add(stores_, relative);
        if (folder.empty()) add(others_, relative);
      } else if (folder.empty() && relative.extension() == ".json") {
        add(others_, relative);
      }
    }
    if (!error) return;
    if (folder.empty())
      throw InputError(root_.string(), fmt::format("cannot be read ({})", error.message()),
                       "check its permissions");
    add(unreadable_, folder / store_name);  // fails with the same reason, unless it can be read
  }

  void add(std::vector<ListedStore>& list, const fs::path& file) {
    list.push_back({name_of(file), root_ / file});
  }

  bool is_output(const fs::path& folder) const {
    std::error_code missing;
    return fs::exists(folder / placement_name, missing) || fs::equivalent(folder, results_, missing) ||
           (fs::exists(folder / database_name, missing) && fs::is_directory(folder / records_name, missing));
  }

  fs::path root_;
  const fs::path& results_;
  std::vector<ListedStore> stores_, others_, unreadable_;
};

void make_names_unique(std::vector<ListedStore>& stores) {
  std::set<std::string> taken;
  for (const ListedStore& store : stores) taken.insert(store.name);
  for (std::size_t k = 1, first = 0; k < stores.size(); ++k) {
    if (stores[k].name != stores[first].name) {
      first = k;
      continue;
    }
    std::size_t number = k - first;
    do stores[k].name = fmt::format("{}~{}", stores[first].name, ++number);
    while (!taken.insert(stores[k].name).second);
  }
}

// A step of a path, cut to at most `most` bytes. Different steps remain different.
std::string fitted(const std::string& step, std::size_t most) {
  if (step.size() <= most) return step;
  constexpr std::size_t digits = 16;
  std::size_t head = most - digits - 1;
  while ((static_cast<unsigned char>(step[head]) & 0xC0U) == 0x80) --head;
  return step.substr(0, head) + "~" + content_hash(step).substr(0, digits);
}

// A step of a folder that does not end like a file, with `of_file`. Different steps remain different.
std::string beside(const std::string& step, std::string_view of_file) {
  const std::size_t end = step.find_last_not_of('_') + 1;
  return std::string_view(step).substr(0, end).ends_with(of_file) ? step + "_" : step;
}

constexpr std::size_t longest_step = 255;  // of Linux's file systems
constexpr std::size_t temporary_part = std::string_view("..shelfbeam-XXXXXX").size();  // of an AtomicFile

}  // namespace

StoreList listed_stores(const fs::path& source, const fs::path& results) {
  std::error_code missing;
  StoreList list =
      fs::is_directory(source, missing) ? StoreList{Tree(source, results).stores(), {}} : from_list(source);
  if (list.stores.empty())
    throw InputError(source.string(), "names no store", "list the paths of store files, one per line");
  const auto sort = [&] {
    std::stable_sort(list.stores.begin(), list.stores.end(),
                     [](const ListedStore& a, const ListedStore& b) { return a.name < b.name; });
  };
  sort();
  make_names_unique(list.stores);
  sort();
  return list;
}

fs::path folder_of_name(const std::string& name) {
  fs::path folder;
  for (const fs::path& step : fs::path(name)) {
    std::string fitting = fitted(step.string(), longest_step);
    // The folder may be in that of the plan of another store.
    for (const std::string_view file : plan_file_names)
      if (fitting.starts_with(file)) fitting = beside(fitting, file);
    folder /= fitting;
  }
  return folder;
}

fs::path file_of_name(const std::string& name, const std::string& extension) {
  const std::size_t most = longest_step - extension.size() - temporary_part;
  const fs::path steps(name);
  fs::path file;
  for (const fs::path& step : steps.parent_path()) file /= beside(fitted(step.string(), most), extension);
  return file / (fitted(steps.filename().string(), most) + extension);
}

}  // namespace shelfbeam::app
