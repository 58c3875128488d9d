#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/inspection/plausibility.hpp"
#include "shelfbeam/report/data/report.hpp"

#include "app/files.hpp"
#include "app/options/arguments.hpp"
#include "app/text/store_summary.hpp"
#include "app/text/terminal.hpp"
#include "app/verbs.hpp"

namespace shelfbeam::app {

namespace {

struct Options {
  CommonOptions common;
  std::filesystem::path store, plan;
  bool allow_outside = false, strict = false;
};

int run_inspect(const Options& options) {
  protect_input(options.plan, options.store);
  const Scene scene = make_inspected_scene(load_store(options.store, options.allow_outside, 0, options.plan));
  if (!options.plan.empty()) write_file(options.plan, floor_plan_svg(scene));
  if (options.common.json) {
    print_json(summary_json(scene));
  } else if (!options.common.quiet) {
    print_summary(scene, options.plan);
  }
  expect_no_warnings(scene, options.strict);
  return done;
}

}  // namespace

void add_inspect(CLI::App& app, ChosenVerb& chosen) {
  CLI::App* verb =
      app.add_subcommand("inspect", "Check a store file; print its dimensions, counts and materials");
  auto options = std::make_shared<Options>();
  add_path(*verb, "STORE", options->store, "Store file (JSON)")->required();
  add_path(*verb, "-o,--output", options->plan, "Write the floor plan as SVG to this file");
  add_store_options(*verb, options->allow_outside);
  add_strict_option(*verb, options->strict);
  add_common_options(*verb, options->common);
  verb->footer("Example:\n  shelfbeam inspect store.json -o plan.svg");
  verb->callback([options, &chosen] { chosen = [options] { return run_inspect(*options); }; });
}

}  // namespace shelfbeam::app
