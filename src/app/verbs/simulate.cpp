#include "shelfbeam/transport/run/simulate.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/inspection/plausibility.hpp"
#include "shelfbeam/plan/states/goal_rules.hpp"
#include "shelfbeam/report/messages/light.hpp"
#include "shelfbeam/report/text/words.hpp"
#include "shelfbeam/scene/states/store_states.hpp"
#include "shelfbeam/signal/checkpoint/checkpoint.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/transport/states/simulate_states.hpp"
#include "shelfbeam/transport/world/coverage.hpp"

#include "app/options/arguments.hpp"
#include "app/options/placement_options.hpp"
#include "app/options/simulation_options.hpp"
#include "app/text/end_at_once.hpp"
#include "app/text/simulation_text.hpp"
#include "app/text/store_summary.hpp"
#include "app/text/style.hpp"
#include "app/text/terminal.hpp"
#include "app/verbs.hpp"
#include "jobs/plan_job.hpp"
#include "jobs/steps/simulation_step.hpp"

namespace shelfbeam::app {

namespace {

struct SimulateArguments {
  CommonOptions common;
  SimulationFlags simulation;
  std::filesystem::path store, output;
  jobs::WantedStates wanted;
  std::optional<std::uint64_t> state;
  std::vector<Cause> without;
  Share part;
  bool allow_outside = false, strict = false;
};

std::string part_text(const Share& part) {
  return part.is_whole() ? "" : fmt::format(" (part {} of {})", part.number, part.count);
}

int simulate_states_to_file(const SimulateArguments& options, const Store& store, const Scene& scene,
                            const SimulationOptions& simulation, const CancelToken& cancel) {
  StoredSignals signals;
  {
    TerminalProgress progress(options.common.quiet);
    const RunControl control{options.common.threads, &cancel, progress.sink()};
    ResultLog log = log_of_states(simulation.checkpoint.path, scene.store_hash, simulation);
    try {
      signals = jobs::simulate_wanted(store, scene, simulation, options.wanted, log, control);
    } catch (const Interrupted&) {
      log.flush();
      if (!options.common.quiet)
        print_message("stopped early: nothing is written; repeat the command with '--resume' to continue\n");
      return stopped_early;
    }
  }
  write_signal_file(signals, options.output);
  remove_checkpoint(simulation.checkpoint.path);
  if (options.common.json)
    print_json({{"signal", options.output.string()},
                {"states", signals.states->states},
                {"hard_labels", signals.states->hard.size()}});
  else if (!options.common.quiet)
    fmt::print("{}: {} labels x {} candidates in {} states; every state of the {} hardest labels{}\n",
               options.output.string(), signals.rows(), signals.columns(), signals.states->states,
               signals.states->hard.size(), part_text(options.part));
  return done;
}

int run_simulate(const SimulateArguments& options) {
  const CancelToken& cancel = cancel_on_signal();
  std::optional<EndAtOnce> reading(stopped_early);
  protect_input(options.output, options.store);
  Store store = read_store(options.store, {.allow_outside = options.allow_outside,
                                           .memory = options.simulation.memory,
                                           .output = options.output,
                                           .cancel = &cancel});
  if (options.wanted.states == 0 && !options.state) expect_no_goal({}, options.without);
  leave_out(store, options.without);
  const Scene nominal = make_inspected_scene(store);
  const Scene scene =
      options.state ? make_scene(jobs::store_in_state(store, nominal, options.common.seed, *options.state))
                    : nominal;
  SimulationOptions simulation = options.simulation.options(options.common.seed, options.output);
  simulation.part = options.part;
  reading.reset();
  const auto lock = jobs::reserve_output(options.output, options.store, scene, simulation);
  print_warnings(options.common, scene, simulation.rules().strategy);
  jobs::expect_no_warnings(scene, options.strict);
  if (options.wanted.states > 0) return simulate_states_to_file(options, store, scene, simulation, cancel);
  SimulationSummary summary;
  {
    TerminalProgress progress(options.common.quiet);
    const RunControl control{options.common.threads, &cancel, progress.sink()};
    summary = simulate_to_file(scene, simulation, options.output, control);
  }
  if (options.common.json) {
    nlohmann::ordered_json json{{"signal", options.output.string()}};
    json.update(jobs::to_json(summary));
    json["warnings"] = sentences(scene.warnings);
    json["found_by_chance"] = light_texts(english(), chance_light(scene, simulation.rules().strategy), scene);
    print_json(json);
  } else if (!options.common.quiet) {
    fmt::print("{}\n", with_answer(fmt::format("{}{}: {}", options.output.string(), part_text(options.part),
                                               describe(summary))));
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
  auto options = std::make_shared<SimulateArguments>();
  const OptionGroup first(*verb), of_states(*verb, group::states);
  first.require("STORE", options->store, a_path(), "Store file (JSON)");
  first.require("-o,--output", options->output, a_path(), "Signal file (HDF5) to write");
  add_simulation_options(*verb, options->simulation, DirectLight::sampled);
  add_layers(*verb, options->simulation);
  auto* states = of_states.add("--states", options->wanted.states, whole_number("N", 1, 100'000),
                               "Simulate the shop in this many states of its 'variation', with few samples "
                               "each: their mean, their deviation, and the hardest labels in each");
  for (const char* other : {"--by-bounce", "--by-length", "--relative-error", "--time"})
    states->excludes(verb->get_option(other));
  of_states
      .add("--hard-labels", options->wanted.hard_labels, whole_number("N", 1, 10'000'000),
           fmt::format("With --states: number of labels whose signals are kept for each state; default {}",
                       options->wanted.hard_labels))
      ->needs(states);
  of_states
      .add_flag("--for-plan", options->wanted.for_plan,
                "With --states: simulate the states for 'plan --sampled', with all labels, their errors, and "
                "reflectances at the low ends of their ranges")
      ->needs(states)
      ->excludes("--hard-labels");
  of_states
      .add("--state", options->state, whole_number("K", 0),
           "Simulate the shop in state K, counted from 0, as 'inspect --state K -o' writes it")
      ->excludes(states);
  add_without(*verb, options->without);
  add_part(*verb, options->part);
  add_run_options(*verb, options->simulation, options->simulation.checkpoint);
  add_store_options(*verb, options->allow_outside);
  add_strict_option(*verb, options->strict);
  finish_verb(*verb, chosen, options, run_simulate,
              "Examples:\n"
              "  shelfbeam simulate store.json -o signal.h5\n"
              "  shelfbeam simulate store.json -o signal.h5 --relative-error 5%\n"
              "  shelfbeam simulate store.json -o signal.h5 --relative-error 5% --resume\n"
              "  shelfbeam simulate store.json -o states.h5 --states 100\n"
              "  shelfbeam simulate store.json -o state17.h5 --state 17\n"
              "  shelfbeam simulate store.json -o part2.h5 --part 2/4");
}

}  // namespace shelfbeam::app
