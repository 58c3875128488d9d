#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/options/arguments.hpp"
#include "app/text/templates.hpp"
#include "app/text/terminal.hpp"
#include "app/verbs.hpp"

namespace shelfbeam::app {

namespace {

struct NewArguments {
  CommonOptions common;
  std::string name;
  std::filesystem::path folder;
};

int run_new(const NewArguments& options) {
  const Template& chosen = write_template(options.name, options.folder);
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
