#include "shelfbeam/transport/run/simulate.hpp"

#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/inspection/plausibility.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/transport/states/simulate_states.hpp"
#include "shelfbeam/transport/world/coverage.hpp"

#include "app/files.hpp"
#include "app/options/arguments.hpp"
#include "app/options/simulation_options.hpp"
#include "app/text/store_summary.hpp"
#include "app/text/style.hpp"
#include "app/text/terminal.hpp"
#include "app/verbs.hpp"

namespace shelfbeam::app {

namespace {

struct Options {
  CommonOptions common;
  SimulationFlags simulation;
  std::filesystem::path store, output;
  std::uint32_t states = 0;
  bool allow_outside = false, strict = false;
};

void simulate_states_to_file(const Options& options, const Store& store, const Scene& scene,
                             const SimulationOptions& simulation, const CancelToken& cancel) {
  SignalMatrix matrix;
  {
    TerminalProgress progress(options.common.quiet);
    const RunControl control{options.common.threads, &cancel, progress.sink()};
    matrix = simulate_states(store, scene, simulation, {.first = 0, .count = options.states}, control);
  }
  write_signal_file(matrix, options.output);
  if (options.common.json)
    print_json({{"signal", options.output.string()}, {"states", options.states}});
  else if (!options.common.quiet)
    fmt::print("{}: {} labels x {} candidates in {} states\n", options.output.string(), matrix.rows(),
               matrix.columns(), options.states);
}

int run_simulate(const Options& options) {
  const CancelToken& cancel = cancel_on_signal();
  protect_input(options.output, options.store);
  const Store store =
      load_store(options.store, options.allow_outside, options.simulation.memory, options.output);
  const Scene scene = make_inspected_scene(store);
  const SimulationOptions simulation = options.simulation.options(options.common.seed, options.output);
  const OutputLock lock(options.output, options.output.string());
  expect_writable(options.output);
  expect_room_for_matrix(options.output.has_parent_path() ? options.output.parent_path() : ".", scene,
                         simulation);
  print_warnings(options.common, scene, simulation.rules().strategy);
  expect_no_warnings(scene, options.strict);
  if (options.states > 0) {
    simulate_states_to_file(options, store, scene, simulation, cancel);
    return done;
  }
  SimulationSummary summary;
  {
    TerminalProgress progress(options.common.quiet);
    const RunControl control{options.common.threads, &cancel, progress.sink()};
    summary = simulate_to_file(scene, simulation, options.output, control);
  }
  if (options.common.json) {
    nlohmann::ordered_json json{{"signal", options.output.string()}};
    json.update(to_json(summary));
    json["warnings"] = scene.warnings;
    json["found_by_chance"] = chance_light(scene, simulation.rules().strategy);
    print_json(json);
  } else if (!options.common.quiet) {
    fmt::print("{}\n", with_answer(fmt::format("{}: {}", options.output.string(), describe(summary))));
  }
  if (summary.complete) return summary.unmet_error ? stopped_early : done;
  if (!options.common.json && !options.common.quiet)
    print_message(
        "stopped early: the file contains the samples so far; repeat the command with '--resume' to "
        "continue\n");
  return stopped_early;
}

}  // namespace

void add_simulate(CLI::App& app, ChosenVerb& chosen) {
  CLI::App* verb =
      app.add_subcommand("simulate", "Compute the signal of every label from every candidate transceiver");
  auto options = std::make_shared<Options>();
  add_path(*verb, "STORE", options->store, "Store file (JSON)")->required();
  add_path(*verb, "-o,--output", options->output, "Signal file (HDF5) to write")->required();
  add_simulation_options(*verb, options->simulation, DirectLight::sampled);
  add_layers(*verb, options->simulation);
  verb->add_option("--states", options->states,
                   "Simulate the shop in this many states of its 'variation', with few samples each")
      ->option_text("N")
      ->check(CLI::Range(1, 100'000));
  add_run_options(*verb, options->simulation);
  add_store_options(*verb, options->allow_outside);
  add_strict_option(*verb, options->strict);
  add_common_options(*verb, options->common);
  verb->footer(
      "Examples:\n"
      "  shelfbeam simulate store.json -o signal.h5\n"
      "  shelfbeam simulate store.json -o signal.h5 --relative-error 5%\n"
      "  shelfbeam simulate store.json -o signal.h5 --relative-error 5% --resume\n"
      "  shelfbeam simulate store.json -o states.h5 --states 100");
  verb->callback([options, &chosen] { chosen = [options] { return run_simulate(*options); }; });
}

}  // namespace shelfbeam::app
