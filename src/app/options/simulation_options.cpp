#include "app/options/simulation_options.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/signal/checkpoint/checkpoint.hpp"

#include "app/options/arguments.hpp"

namespace shelfbeam::app {

SimulationOptions SimulationFlags::options(std::uint64_t seed, const std::filesystem::path& output) const {
  CheckpointOptions beside = checkpoint;
  beside.path = checkpoint_path(output);
  return SimulationRequest::options(seed, std::move(beside));
}

void add_simulation_options(CLI::App& verb, SimulationRequest& request, DirectLight default_direct) {
  request.default_direct = default_direct;
  const OptionGroup simulation(verb, group::simulation);
  auto* samples =
      OptionGroup(verb).add("--samples", request.samples, whole_number("N", 64, std::uint64_t{1} << 36),
                            "Samples per label; default 10000 without --relative-error and --time");
  auto* error =
      simulation
          .add("--relative-error", request.relative_error, a_share("E", {0, 1, false}),
               "Stop when 99 % of the entries (see --above) have at most this relative standard error, e.g. "
               "0.05 or 5%")
          ->excludes(samples);
  auto* share = simulation
                    .add("--above", request.above, a_share("SHARE", any_share),
                         fmt::format("With --relative-error: use the entries above this share of the "
                                     "requirement; default {}",
                                     SimulationRequest::default_above))
                    ->needs(error)
                    ->excludes(samples);
  simulation
      .add("--max-samples", request.max_samples, whole_number("N", 2096, std::uint64_t{1} << 36),
           fmt::format("With --relative-error: maximum number of samples per label; default {}",
                       RelativeError{}.max_samples))
      ->excludes(samples);
  simulation
      .add("--time", request.time_s, positive_number("SECONDS"),
           "Time limit of the simulation in seconds, instead of --samples")
      ->excludes(samples)
      ->excludes(error)
      ->excludes(share);
  simulation.add_choice("--estimator", request.estimator,
                        "reuse (default): neighbouring labels share paths; uniform: the paper's random walk");
  simulation.add_choice(
      "--direct", request.direct,
      fmt::format("With uniform: direct light sampled by the walk, or exact in closed form; default {}",
                  to_text(default_direct)));
  simulation.add_choice(
      "--strategy", request.strategy,
      "With uniform: path sampling. walk: random hits only; nee: next event estimation; mis (default): both, "
      "combined by multiple importance sampling; particle: from the transceivers");
  simulation.add_choice("--heuristic", request.heuristic, "With uniform: MIS weights; default balance");
  simulation.add("--max-bounces", request.max_bounces, whole_number("N", 0, 1000),
                 "With uniform: maximum number of reflections and refractions per path; default: no limit");
}

void add_layers(CLI::App& verb, SimulationRequest& request) {
  const OptionGroup simulation(verb, group::simulation);
  simulation
      .add_flag("--by-bounce", request.by_bounce,
                "Also store one matrix per number of bounces; requires --max-bounces")
      ->needs("--max-bounces");
  simulation.add("--by-length", request.by_length, positive_number("METRES"),
                 "With uniform: also store one matrix per step of the path length, in metres");
  simulation
      .add("--lengths", request.lengths, whole_number("N", 1, SimulationRequest::max_lengths),
           fmt::format("Number of steps of --by-length; default {}; the last step includes all longer paths",
                       SimulationRequest::default_lengths))
      ->needs("--by-length");
}

void add_part(CLI::App& verb, Share& part) {
  OptionGroup(verb, group::runs)
      .add_call<std::string>(
          "--part", [&part](const std::string& text) { part = share_of(text).value(); }, a_part(),
          "Simulate one of several parts, e.g. 2/4, for 'merge': some of the labels, or of the states")
      ->excludes("--relative-error")
      ->excludes("--time");
}

void add_run_options(CLI::App& verb, SimulationRequest& request, CheckpointOptions& checkpoint) {
  const OptionGroup runs(verb, group::runs);
  runs.add("--memory", request.memory, size_in_bytes(),
           "Memory limit, e.g. 4G or 500M; default: 80 % of the memory that the program may use");
  runs.add_flag("--resume", checkpoint.resume,
                "Continue an interrupted run from its checkpoint, if there is one");
  runs.add("--checkpoint-interval", checkpoint.interval_s, number_from_zero("SECONDS"),
           fmt::format("Minimum time between checkpoints in seconds; default {}; 0: after every round of "
                       "batches",
                       checkpoint.interval_s));
}

}  // namespace shelfbeam::app
