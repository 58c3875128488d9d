#include <filesystem>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/signal/parts/merge_parts.hpp"

#include "app/options/arguments.hpp"
#include "app/text/style.hpp"
#include "app/text/terminal.hpp"
#include "app/verbs.hpp"

namespace shelfbeam::app {

namespace {

struct MergeArguments {
  CommonOptions common;
  std::vector<std::filesystem::path> parts;
  std::filesystem::path output;
};

int run_merge(const MergeArguments& options) {
  for (const auto& part : options.parts) protect_input(options.output, part);
  const OutputLock lock(options.output, options.output.string());
  expect_writable(options.output);
  const MergedParts merged = merge_parts(options.parts, options.output);
  if (options.common.json)
    print_json({{"signal", options.output.string()},
                {"parts", options.parts.size()},
                {"labels", merged.labels},
                {"transceivers", merged.candidates},
                {"states", merged.states}});
  else if (!options.common.quiet)
    fmt::print("{}\n",
               with_answer(fmt::format("{}: {} labels x {} candidates{}, from {} parts",
                                       options.output.string(), merged.labels, merged.candidates,
                                       merged.states > 0 ? fmt::format(" in {} states", merged.states) : "",
                                       options.parts.size())));
  return done;
}

}  // namespace

void add_merge(CLI::App& app, ChosenVerb& chosen) {
  CLI::App* verb = app.add_subcommand("merge", "Join the parts of a simulation to one signal file");
  auto options = std::make_shared<MergeArguments>();
  verb->add_option("PARTS", options->parts, "Outputs of 'simulate --part', in any order")->required();
  OptionGroup(*verb).require("-o,--output", options->output, a_path(), "Signal file (HDF5) to write");
  finish_verb(*verb, chosen, options, run_merge,
              "The result is the file that 'simulate' writes without '--part', byte for byte.\n\n"
              "Examples:\n"
              "  shelfbeam simulate store.json --part 1/2 -o part1.h5\n"
              "  shelfbeam simulate store.json --part 2/2 -o part2.h5\n"
              "  shelfbeam merge part1.h5 part2.h5 -o signal.h5");
}

}  // namespace shelfbeam::app
