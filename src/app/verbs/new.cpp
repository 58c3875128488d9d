#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/scene/build/templates.hpp"

#include "app/options/arguments.hpp"
#include "app/text/print_json.hpp"
#include "app/verbs.hpp"

namespace shelfbeam::app {

namespace {

struct Options {
  CommonOptions common;
  std::string name;
  std::filesystem::path folder;
};

int run_new(const Options& options) {
  const StoreTemplate& chosen = find_template(options.name);
  for (const TemplateFile& file : chosen.files)
    if (const auto path = options.folder / file.name; std::filesystem::exists(path))
      throw InputError(path.string(), "exists already", "choose another folder, or remove the file");
  make_output_folder(options.folder);
  for (const TemplateFile& file : chosen.files) write_file(options.folder / file.name, file.content);
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
  CLI::App* verb = app.add_subcommand("new", "Write a ready store to start from");
  auto options = std::make_shared<Options>();
  std::string names, choices;
  for (const StoreTemplate& t : store_templates()) {
    names += fmt::format("\n  {:<11} {}", t.name, t.description);
    choices += fmt::format("{}{}", choices.empty() ? "" : ",", t.name);
  }
  verb->add_option("TEMPLATE", options->name, "One of:" + names)->required()->type_name("{" + choices + "}");
  verb->add_option("DIR", options->folder, "Folder for the store file and what it needs")
      ->required()
      ->check(a_path());
  add_common_options(*verb, options->common);
  verb->footer("Examples:\n  shelfbeam new grocery my-store\n  shelfbeam new thesis thesis");
  verb->callback([options, &chosen] { chosen = [options] { return run_new(*options); }; });
}

}  // namespace shelfbeam::app
