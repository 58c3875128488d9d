#include "app/options/simulation_options.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/memory.hpp"
#include "shelfbeam/signal/checkpoint/checkpoint.hpp"

#include "app/options/arguments.hpp"

namespace shelfbeam::app {

namespace {

constexpr double default_above = 0.3;
constexpr std::uint32_t default_lengths = 64;

// The minimum number of batches exceeds the requested samples by more than one batch.
bool exceeds_requested_samples(const SimulationSummary& summary) {
  return summary.requested_samples && summary.max_batches == min_batches &&
         summary.max_samples >= *summary.requested_samples + summary.max_samples / summary.max_batches;
}

}  // namespace

SimulationOptions SimulationFlags::options(std::uint64_t seed, const std::filesystem::path& output) const {
  SimulationOptions options;
  options.estimator = kind();
  options.seed = seed;
  options.time_s = time_s;
  if (relative_error)
    options.relative_error = RelativeError{*relative_error, above.value_or(default_above),
                                           max_samples.value_or(RelativeError{}.max_samples)};
  if (samples) options.samples = *samples;
  if (above && !relative_error)
    throw InputError("--above", "has no effect without '--relative-error'", "add it");
  if (max_samples && !relative_error)
    throw InputError("--max-samples", "has no effect without '--relative-error'", "use '--samples'");
  if (options.estimator == EstimatorKind::reuse) {
    options.direct = DirectLight::exact;
  } else {
    options.direct = direct.value_or(default_direct);
    options.strategy = strategy.value_or(options.strategy);
    options.heuristic = heuristic.value_or(options.heuristic);
    options.max_bounces = max_bounces.value_or(PathRules::no_limit);
    options.by_bounce = by_bounce;
    if (by_length) options.by_length = {*by_length, lengths.value_or(default_lengths)};
  }
  options.memory = memory == 0 ? memory_limit() : memory;
  options.checkpoint.path = checkpoint_path(output);
  options.checkpoint.resume = resume;
  options.checkpoint.interval_s = checkpoint_interval_s;
  return options;
}

// Without --estimator, an option of the uniform estimator selects it.
EstimatorKind SimulationFlags::kind() const {
  const char* of_uniform = strategy      ? "--strategy"
                           : heuristic   ? "--heuristic"
                           : max_bounces ? "--max-bounces"
                           : by_length   ? "--by-length"
                           : direct      ? "--direct"
                                         : nullptr;
  if (!estimator) return of_uniform != nullptr ? EstimatorKind::uniform : EstimatorKind::reuse;
  if (estimator == EstimatorKind::uniform) return EstimatorKind::uniform;
  if (of_uniform != nullptr &&
      (strategy || heuristic || max_bounces || by_length || direct == DirectLight::sampled))
    throw InputError(of_uniform, "does not apply to the estimator reuse",
                     "remove it, or use '--estimator uniform'");
  return EstimatorKind::reuse;
}

void add_simulation_options(CLI::App& verb, SimulationFlags& flags, DirectLight default_direct) {
  flags.default_direct = default_direct;
  auto* samples = verb.add_option("--samples", flags.samples,
                                  "Samples per label; default 10000 without --relative-error and --time")
                      ->check(whole_number(64, std::uint64_t{1} << 36))
                      ->option_text("N");
  auto* error =
      verb.add_option(
              "--relative-error", flags.relative_error,
              "Stop when 99 % of the entries (see --above) have at most this relative standard error, e.g. "
              "0.05 or 5%")
          ->transform(a_share({0, 1, false}))
          ->option_text("E")
          ->group(group::simulation)
          ->excludes(samples);
  auto* share = verb.add_option("--above", flags.above,
                                fmt::format("With --relative-error: use the entries above this share of the "
                                            "requirement; default {}",
                                            default_above))
                    ->transform(a_share(any_share))
                    ->option_text("SHARE")
                    ->group(group::simulation)
                    ->excludes(samples);
  verb.add_option("--max-samples", flags.max_samples,
                  fmt::format("With --relative-error: maximum number of samples per label; default {}",
                              RelativeError{}.max_samples))
      ->check(whole_number(2096, std::uint64_t{1} << 36))
      ->option_text("N")
      ->group(group::simulation)
      ->excludes(samples);
  verb.add_option("--time", flags.time_s, "Time limit of the simulation in seconds, instead of --samples")
      ->check(positive_number())
      ->option_text("SECONDS")
      ->group(group::simulation)
      ->excludes(samples)
      ->excludes(error)
      ->excludes(share);
  add_choice(verb, "--estimator", flags.estimator,
             "reuse (default): neighbouring labels share paths; uniform: the paper's random walk")
      ->group(group::simulation);
  add_choice(
      verb, "--direct", flags.direct,
      fmt::format("With uniform: direct light sampled by the walk, or exact in closed form; default {}",
                  to_text(default_direct)))
      ->group(group::simulation);
  add_choice(verb, "--strategy", flags.strategy,
             "With uniform: path sampling. walk: random hits only; nee: next event estimation; mis "
             "(default): both, combined by multiple importance sampling; particle: from the transceivers")
      ->group(group::simulation);
  add_choice(verb, "--heuristic", flags.heuristic, "With uniform: MIS weights; default balance")
      ->group(group::simulation);
  verb.add_option("--max-bounces", flags.max_bounces,
                  "With uniform: maximum number of reflections and refractions per path; default: no limit")
      ->check(whole_number(0, 1000))
      ->option_text("N")
      ->group(group::simulation);
}

void add_layers(CLI::App& verb, SimulationFlags& flags) {
  verb.add_flag("--by-bounce", flags.by_bounce,
                "Also store one matrix per number of bounces; requires --max-bounces")
      ->needs("--max-bounces")
      ->group(group::simulation);
  verb.add_option("--by-length", flags.by_length,
                  "With uniform: also store one matrix per step of the path length, in metres")
      ->check(positive_number())
      ->option_text("METRES")
      ->group(group::simulation);
  verb.add_option(
          "--lengths", flags.lengths,
          fmt::format("Number of steps of --by-length; default {}; the last step includes all longer paths",
                      default_lengths))
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

void add_run_options(CLI::App& verb, SimulationFlags& flags) {
  verb.add_option("--memory", flags.memory,
                  "Memory limit, e.g. 4G or 500M; default: 80 % of the memory that the program may use")
      ->transform(size_in_bytes())
      ->option_text("SIZE")
      ->group(group::runs);
  verb.add_flag("--resume", flags.resume, "Continue an interrupted run from its checkpoint, if there is one")
      ->group(group::runs);
  verb.add_option("--checkpoint-interval", flags.checkpoint_interval_s,
                  fmt::format("Minimum time between checkpoints in seconds; default {}; 0: after every round "
                              "of batches",
                              flags.checkpoint_interval_s))
      ->check(number_from_zero())
      ->option_text("SECONDS")
      ->group(group::runs);
}

std::string describe(const SimulationSummary& summary, bool follows_decision) {
  const std::string samples = summary.min_samples == summary.max_samples
                                  ? fmt::format("{}", summary.min_samples)
                                  : fmt::format("{} to {}", summary.min_samples, summary.max_samples);
  std::string text = fmt::format(
      "{} labels x {} candidates, {} samples per label in {:.1f} s ({:.2f} million rays per "
      "second)",
      summary.labels, summary.candidates, samples, summary.seconds,
      static_cast<double>(summary.rays) / summary.seconds / 1e6);
  if (exceeds_requested_samples(summary))
    text +=
        fmt::format("\n{} samples per label instead of {}: at least {} batches are needed to estimate errors",
                    samples, *summary.requested_samples, min_batches);
  if (summary.resumed_batches > 0)
    text += fmt::format("\ncontinued from the checkpoint, which contained {} of the {} batches",
                        summary.resumed_batches, summary.batches);
  for (const ErrorQuantiles& errors : summary.errors) {
    if (errors.entries == 0)
      text += fmt::format("\nno entry exceeds {} of the requirement", errors.above);
    else
      text += fmt::format(
          "\nrelative standard error of the {} entries above {} of the requirement: median {:.1f} %, "
          "90 % below {:.1f} %, 99 % below {:.1f} %",
          errors.entries, errors.above, 100 * errors.median, 100 * errors.p90, 100 * errors.p99);
    if (errors.flagged > 0) text += fmt::format("; {} of them flagged", errors.flagged);
  }
  if (std::any_of(summary.errors.begin(), summary.errors.end(),
                  [](const ErrorQuantiles& errors) { return errors.flagged > 0; }))
    text += fmt::format(
        "\nflagged: few batches found most of the light, so the error is not reliable{}. '/flags' in "
        "the signal file marks these entries",
        follows_decision ? "" : "; use more samples");
  if (summary.unmet_error) {
    text += fmt::format(
        "\n{2} entries have not reached a relative error of {0:g} %, and {1} of these require more than "
        "--max-samples; the largest errors:",
        100 * *summary.unmet_error, summary.out_of_reach, summary.unmet);
    for (const UnmetEntry& entry : summary.worst_unmet)
      text += fmt::format("\n  label '{}' from '{}': {:.1f} %{}{}", entry.label, entry.source,
                          100 * entry.relative_error, entry.is_flagged ? ", flagged" : "",
                          entry.is_out_of_reach ? ", requires more than --max-samples" : "");
  }
  return text + (follows_decision ? "\nthe certificate takes more samples only where they decide; all other "
                                    "entries keep these errors"
                                  : fmt::format("\nhalving these errors would take another {:.0f} s",
                                                summary.seconds_to_halve));
}

nlohmann::ordered_json to_json(const SimulationSummary& summary) {
  nlohmann::ordered_json errors = nlohmann::ordered_json::array();
  for (const ErrorQuantiles& e : summary.errors)
    errors.push_back({{"above", e.above},
                      {"entries", e.entries},
                      {"flagged", e.flagged},
                      {"median", e.median},
                      {"p90", e.p90},
                      {"p99", e.p99}});
  nlohmann::ordered_json unmet;
  if (summary.unmet_error) {
    unmet = {{"error", *summary.unmet_error},
             {"entries", summary.unmet},
             {"out_of_reach", summary.out_of_reach},
             {"worst", nlohmann::ordered_json::array()}};
    for (const UnmetEntry& entry : summary.worst_unmet)
      unmet["worst"].push_back({{"label", entry.label},
                                {"transceiver", entry.source},
                                {"relative_error", entry.relative_error},
                                {"flagged", entry.is_flagged},
                                {"out_of_reach", entry.is_out_of_reach}});
  }
  nlohmann::ordered_json asked;
  if (summary.requested_samples) asked = *summary.requested_samples;
  return {{"labels", summary.labels},
          {"transceivers", summary.candidates},
          {"complete", summary.complete},
          {"samples", {summary.min_samples, summary.max_samples}},
          {"asked", asked},
          {"batches", {summary.min_batches, summary.max_batches}},
          {"resumed_batches", summary.resumed_batches},
          {"rays", summary.rays},
          {"shadow_rays",
           {{"connections", summary.shadow_rays.connections},
            {"traced", summary.shadow_rays.traced},
            {"occluded", summary.shadow_rays.occluded}}},
          {"seconds", summary.seconds},
          {"rays_per_second", static_cast<double>(summary.rays) / summary.seconds},
          {"relative_errors", errors},
          {"unmet", unmet},
          {"seconds_to_halve_the_errors", summary.seconds_to_halve}};
}

}  // namespace shelfbeam::app
