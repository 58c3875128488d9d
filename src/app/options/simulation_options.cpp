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
  auto* samples = verb.add_option("--samples", request.samples,
                                  "Samples per label; default 10000 without --relative-error and --time")
                      ->check(whole_number(64, std::uint64_t{1} << 36))
                      ->option_text("N");
  auto* error =
      verb.add_option(
              "--relative-error", request.relative_error,
              "Stop when 99 % of the entries (see --above) have at most this relative standard error, e.g. "
              "0.05 or 5%")
          ->transform(a_share({0, 1, false}))
          ->option_text("E")
          ->group(group::simulation)
          ->excludes(samples);
  auto* share = verb.add_option("--above", request.above,
                                fmt::format("With --relative-error: use the entries above this share of the "
                                            "requirement; default {}",
                                            SimulationRequest::default_above))
                    ->transform(a_share(any_share))
                    ->option_text("SHARE")
                    ->group(group::simulation)
                    ->needs(error)
                    ->excludes(samples);
  verb.add_option("--max-samples", request.max_samples,
                  fmt::format("With --relative-error: maximum number of samples per label; default {}",
                              RelativeError{}.max_samples))
      ->check(whole_number(2096, std::uint64_t{1} << 36))
      ->option_text("N")
      ->group(group::simulation)
      ->excludes(samples);
  verb.add_option("--time", request.time_s, "Time limit of the simulation in seconds, instead of --samples")
      ->check(positive_number())
      ->option_text("SECONDS")
      ->group(group::simulation)
      ->excludes(samples)
      ->excludes(error)
      ->excludes(share);
  add_choice(verb, "--estimator", request.estimator,
             "reuse (default): neighbouring labels share paths; uniform: the paper's random walk")
      ->group(group::simulation);
  add_choice(
      verb, "--direct", request.direct,
      fmt::format("With uniform: direct light sampled by the walk, or exact in closed form; default {}",
                  to_text(default_direct)))
      ->group(group::simulation);
  add_choice(verb, "--strategy", request.strategy,
             "With uniform: path sampling. walk: random hits only; nee: next event estimation; mis "
             "(default): both, combined by multiple importance sampling; particle: from the transceivers")
      ->group(group::simulation);
  add_choice(verb, "--heuristic", request.heuristic, "With uniform: MIS weights; default balance")
      ->group(group::simulation);
  verb.add_option("--max-bounces", request.max_bounces,
                  "With uniform: maximum number of reflections and refractions per path; default: no limit")
      ->check(whole_number(0, 1000))
      ->option_text("N")
      ->group(group::simulation);
}

void add_layers(CLI::App& verb, SimulationRequest& request) {
  verb.add_flag("--by-bounce", request.by_bounce,
                "Also store one matrix per number of bounces; requires --max-bounces")
      ->needs("--max-bounces")
      ->group(group::simulation);
  verb.add_option("--by-length", request.by_length,
                  "With uniform: also store one matrix per step of the path length, in metres")
      ->check(positive_number())
      ->option_text("METRES")
      ->group(group::simulation);
  verb.add_option(
          "--lengths", request.lengths,
          fmt::format("Number of steps of --by-length; default {}; the last step includes all longer paths",
                      SimulationRequest::default_lengths))
      ->check(whole_number(1, 10000))
      ->option_text("N")
      ->needs("--by-length")
      ->group(group::simulation);
}

void add_part(CLI::App& verb, Share& part) {
  verb.add_option_function<std::string>(
          "--part", [&part](const std::string& text) { part = share_of(text).value(); },
          "Simulate one of several parts, e.g. 2/4, for 'merge': some of the labels, or of the states")
      ->check(a_part())
      ->option_text("K/N")
      ->excludes("--relative-error")
      ->excludes("--time")
      ->group(group::runs);
}

void add_run_options(CLI::App& verb, SimulationRequest& request, CheckpointOptions& checkpoint) {
  verb.add_option("--memory", request.memory,
                  "Memory limit, e.g. 4G or 500M; default: 80 % of the memory that the program may use")
      ->transform(size_in_bytes())
      ->option_text("SIZE")
      ->group(group::runs);
  verb.add_flag("--resume", checkpoint.resume,
                "Continue an interrupted run from its checkpoint, if there is one")
      ->group(group::runs);
  verb.add_option("--checkpoint-interval", checkpoint.interval_s,
                  fmt::format("Minimum time between checkpoints in seconds; default {}; 0: after every round "
                              "of batches",
                              checkpoint.interval_s))
      ->check(number_from_zero())
      ->option_text("SECONDS")
      ->group(group::runs);
}

}  // namespace shelfbeam::app
