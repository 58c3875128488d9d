#include "serve/project/vendor_catalogue.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/json.hpp"
#include "shelfbeam/base/json_parser.hpp"
#include "shelfbeam/scene/build/draft.hpp"
#include "shelfbeam/scene/store/store.hpp"

#include "serve/text/edit.hpp"

namespace shelfbeam::serve {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

// The pictures and emission profiles that types of a catalogue name.
void add_named_files(const Json& json, std::vector<std::string>& names) {
  if (!json.is_structured()) return;
  for (const auto& [key, value] : json.items()) {
    add_named_files(value, names);
    if ((key != "picture" && key != "file") || !value.is_string()) continue;
    const auto name = value.get<std::string>();
    if (!name.starts_with("data:") && std::ranges::count(names, name) == 0) names.push_back(name);
  }
}

// New files in the folder of a project, which are removed again unless they are kept.
class Copies {
 public:
  explicit Copies(const fs::path& folder) : folder_(folder) {}
  ~Copies() {
    std::error_code ignored;
    for (const fs::path& made : made_) fs::remove(made, ignored);
  }
  Copies(const Copies&) = delete;
  Copies& operator=(const Copies&) = delete;

  void add(const fs::path& from, const std::string& name) {
    constexpr std::uint64_t most = 64 << 20;
    const fs::path copy = (folder_ / name).lexically_normal(), inside = copy.lexically_relative(folder_);
    if (fs::path(name).is_absolute() || *inside.begin() == "..")
      throw InputError(from.string(), "lies outside the folder of the catalogue", "move it there");
    const std::string content = read_file(from, most);
    if (!fs::exists(fs::symlink_status(copy))) {
      if (copy.has_parent_path()) make_output_folder(copy.parent_path());
      write_file(copy, content);
      made_.push_back(copy);
    } else if (!fs::is_regular_file(fs::symlink_status(copy)) || read_file(copy, most) != content) {
      throw InputError(copy.string(), fmt::format("is another file than '{}'", from.string()),
                       "rename one of the two, or replace this file by the other");
    }
  }
  void keep() { made_.clear(); }

 private:
  fs::path folder_;
  std::vector<fs::path> made_;
};

std::size_t problems_of(const Json& store, const fs::path& folder, std::string& first) {
  const Draft draft = read_draft(JsonCursor::parse(store.dump(), "store.json"), folder, SceneDetail::outlines,
                                 {.allow_links = false});
  if (!draft.problems.empty()) first = draft.problems.front().sentence;
  return draft.problems.size();
}

}  // namespace

void add_catalogue(const fs::path& file, const fs::path& folder, Project& project) {
  const std::string name = file.filename().string();
  expect_catalogue(JsonCursor::parse(read_file(file), file.string()));
  const Json store = parse_json(project.text(), "store.json");
  Copies copies(folder);
  copies.add(file, name);
  EditOp op{"/catalogues", {}, Json::array({name})};
  if (const auto listed = store.find("catalogues"); listed != store.end()) {
    if (!listed->is_array())
      throw InputError("store.json: catalogues", "is not a list", "give the names of files in a list");
    if (std::any_of(listed->begin(), listed->end(), [&](const Json& one) { return one == name; }))
      return copies.keep();
    op = {fmt::format("/catalogues/{}", listed->size()), {}, name};
  }
  std::vector<std::string> named;
  add_named_files(parse_json(read_file(file), file.string()), named);
  for (const std::string& other : named) copies.add(file.parent_path() / other, other);
  Json with = store;
  with["catalogues"].push_back(name);
  std::string before, after;
  if (problems_of(with, folder, after) > problems_of(store, folder, before))
    throw InputError(file.string(), fmt::format("does not fit the shop: {}", after),
                     "correct the catalogue or the shop");
  project.edit(fmt::format("Catalogue {}", name), {op});
  copies.keep();
}

}  // namespace shelfbeam::serve
