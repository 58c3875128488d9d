#include "serve/project/archive.hpp"

#include <filesystem>
#include <memory>

#include "app/options/arguments.hpp"
#include "app/text/terminal.hpp"
#include "app/verbs.hpp"

namespace shelfbeam::app {

namespace {

struct ArchiveArguments {
  CommonOptions common;
  std::filesystem::path project, output;
};

int run_archive(const ArchiveArguments& options) {
  const serve::ArchiveSize size = serve::write_archive(options.project, options.output);
  print_json({{"files", size.files}, {"bytes", size.bytes}});
  return done;
}

}  // namespace

void add_archive(CLI::App& app, ChosenVerb& chosen) {
  CLI::App* verb = app.add_subcommand("archive", "Write a project as one zip file for the planner");
  auto options = std::make_shared<ArchiveArguments>();
  const OptionGroup first(*verb);
  first.require("PROJECT", options->project, a_path(), "Folder with a store.json");
  first.require("-o,--output", options->output, a_path(), "Zip file");
  finish_verb(*verb, chosen, options, run_archive, "Example:\n  shelfbeam archive my-shop -o my-shop.zip");
}

}  // namespace shelfbeam::app
