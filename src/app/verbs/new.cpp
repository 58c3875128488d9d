#include <array>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/text.hpp"

#include "app/options/arguments.hpp"
#include "app/text/terminal.hpp"
#include "app/verbs.hpp"

namespace shelfbeam::embedded {

// Names and contents of the files of examples/, made by cmake/embed.cmake.
extern const std::span<const std::pair<std::string_view, std::string_view>> templates;

}  // namespace shelfbeam::embedded

namespace shelfbeam::app {

namespace {

/// An example store; its files are those of the folder of the same name in examples/.
struct Template {
  std::string_view name, description;
};

constexpr std::array<Template, 6> store_templates{
    {{"thesis", "the test environment of the paper: 390 labels, 320 candidates"},
     {"grocery", "a small grocery with gondolas, freezers and checkouts"},
     {"chiller", "a petrol station shop with glass doors and aimed units"},
     {"market-hall", "an L-shaped hall: zones, inner walls, presets, a planogram"},
     {"supermarket", "50 x 40 m: 5,000 labels, 600 candidates"},
     {"hypermarket", "110 x 85 m: 40,000 labels, 2,000 candidates"}}};

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

struct NewArguments {
  CommonOptions common;
  std::string name;
  std::filesystem::path folder;
};

int run_new(const NewArguments& options) {
  const Template& chosen = find_template(options.name);
  const auto files = files_of(chosen);
  for (const auto& [name, content] : files)
    if (const auto path = options.folder / name; std::filesystem::exists(path))
      throw InputError(path.string(), "already exists", "choose another folder, or remove the file");
  make_output_folder(options.folder);
  for (const auto& [name, content] : files) write_file(options.folder / name, content);
  const std::string store = (options.folder / "store.json").string();
  if (options.common.json) {
    print_json({{"store", store}});
  } else if (!options.common.quiet) {
    fmt::print("{}: {}\nnext: shelfbeam plan {} -o {}\n", store, chosen.description, store,
               (options.folder / "plan").string());
  }
  return done;
}

}  // namespace

void add_new(CLI::App& app, ChosenVerb& chosen) {
  CLI::App* verb = app.add_subcommand("new", "Write an example store to start from");
  auto options = std::make_shared<NewArguments>();
  std::string descriptions;
  std::vector<std::string> names;
  for (const Template& t : store_templates) {
    descriptions += fmt::format("\n  {:<11}  {}", t.name, t.description);
    names.emplace_back(t.name);
  }
  const OptionGroup first(*verb);
  first.require("TEMPLATE", options->name, CLI::Validator(choices(names)), "Example to copy; see below");
  first.require("DIR", options->folder, a_path(), "Folder for the store file and the files that it names");
  finish_verb(*verb, chosen, options, run_new,
              "Templates:" + descriptions + "\n\nExample:\n  shelfbeam new grocery my-store");
}

}  // namespace shelfbeam::app
