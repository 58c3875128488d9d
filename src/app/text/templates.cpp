#include "app/text/templates.hpp"

#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/text.hpp"

namespace shelfbeam::embedded {

// Names and contents of the files of examples/, made by cmake/embed.cmake.
extern const std::span<const std::pair<std::string_view, std::string_view>> templates;

}  // namespace shelfbeam::embedded

namespace shelfbeam::app {

namespace {

// Their paths within its folder, and contents.
std::vector<std::pair<std::string_view, std::string_view>> files_of(const Template& chosen) {
  std::vector<std::pair<std::string_view, std::string_view>> files;
  for (const auto& [path, content] : embedded::templates)
    if (path.substr(0, path.find('/')) == chosen.name)
      files.emplace_back(path.substr(chosen.name.size() + 1), content);
  return files;
}

const Template& find_template(const std::string& name) {
  std::vector<std::string_view> known;
  for (const Template& t : store_templates) {
    if (t.name == name) return t;
    known.push_back(t.name);
  }
  throw InputError("TEMPLATE", fmt::format("unknown template '{}'", name), suggest(name, known));
}

}  // namespace

const Template& write_template(const std::string& name, const std::filesystem::path& folder) {
  const Template& chosen = find_template(name);
  const auto files = files_of(chosen);
  for (const auto& [file, content] : files)
    if (const auto path = folder / file; std::filesystem::exists(path))
      throw InputError(path.string(), "already exists", "choose another folder, or remove the file");
  make_output_folder(folder);
  for (const auto& [file, content] : files) write_file(folder / file, content);
  return chosen;
}

}  // namespace shelfbeam::app
