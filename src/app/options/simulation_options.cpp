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

// More than the next whole batch after those asked for, as errors need some batches.
bool exceeds_what_was_asked(const SimulationSummary& summary) {
  return summary.asked_samples && summary.most_batches == least_batches &&
         summary.most_samples >= *summary.asked_samples + summary.most_samples / summary.most_batches;
}

}  // namespace

SimulationOptions SimulationFlags::options(std::uint64_t seed, const std::filesystem::path& output) const {
  SimulationOptions options;
  options.estimator = kind();
  options.seed = seed;
  options.time_s = time_s;
  if (relative_error)
    options.relative_error = RelativeError{*relative_error, above.value_or(default_above),
                                           max_samples.value_or(RelativeError{}.most_samples)};
  if (samples) options.samples = *samples;
  if (above && !relative_error)
    throw InputError("--above", "says nothing without '--relative-error'", "add that");
  if (max_samples && !relative_error)
    throw InputError("--max-samples", "says nothing without '--relative-error'", "use '--samples'");
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
  options.memory = memory == 0 ? most_of_the_memory() : memory;
  options.checkpoint = {checkpoint_path(output), resume, checkpoint_interval_s};
  return options;
}

// What only the uniform estimator knows asks for it.
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
    throw InputError(of_uniform, "is not for the estimator reuse",
                     "leave it out, or use '--estimator uniform'");
  return EstimatorKind::reuse;
}

void add_simulation_options(CLI::App& verb, SimulationFlags& flags, DirectLight default_direct) {
  flags.default_direct = default_direct;
  add_choice(verb, "--estimator", flags.estimator,
             "reuse (default): paths shared by neighbouring labels, all transceivers at once; uniform: the "
             "paper's random walk with one uniformly chosen transceiver a vertex");
  auto* error = verb.add_option("--relative-error", flags.relative_error,
                                "Stop when 99 % of the entries that matter have this relative standard error")
                    ->check(positive_number());
  auto* share =
      verb.add_option("--above", flags.above,
                      fmt::format("Entries matter from this share of their label's requirement on ({}), for "
                                  "--relative-error",
                                  default_above))
          ->check(positive_number());
  auto* most = verb.add_option("--max-samples", flags.max_samples,
                               fmt::format("Most first rays per label under --relative-error ({})",
                                           RelativeError{}.most_samples))
                   ->check(CLI::Range(std::uint64_t{2096}, std::uint64_t{1} << 36));
  auto* samples =
      verb.add_option("--samples", flags.samples,
                      "First rays per label (particles per transceiver), rounded up to whole "
                      "batches (at least 16 with reuse); 10000 unless an error or a time is given")
          ->check(CLI::Range(std::uint64_t{64}, std::uint64_t{1} << 36))
          ->excludes(error)
          ->excludes(share)
          ->excludes(most);
  verb.add_option("--time", flags.time_s, "Instead of either: seconds to simulate")
      ->check(positive_number())
      ->excludes(samples)
      ->excludes(error)
      ->excludes(share);
  add_choice(verb, "--direct", flags.direct,
             fmt::format("Direct light of uniform: sampled by the walk, as in the paper, or exact in closed "
                         "form ({})",
                         to_text(default_direct)));
  add_choice(verb, "--strategy", flags.strategy,
             "How uniform finds paths are found: walk (until a transceiver of some size is met), nee (next "
             "event estimation), mis (both, weighted), particle (from the transceivers)");
  add_choice(verb, "--heuristic", flags.heuristic, "Weights of mis");
  verb.add_option("--max-bounces", flags.max_bounces, "Longest paths of uniform: reflections and refractions")
      ->check(CLI::Range(0, 1000));
  verb.add_option("--memory", flags.memory,
                  "Memory that may be used, e.g. 4G or 500M (default: 80 % of what the machine has)")
      ->transform(CLI::AsSizeValue(true))
      ->check(positive_number());
  verb.add_flag("--resume", flags.resume, "Go on from the checkpoint of an interrupted run, if there is one");
  verb.add_option("--checkpoint-interval", flags.checkpoint_interval_s,
                  "Seconds between checkpoints, at least; 0 is one whenever batches have been added")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
}

void add_layers(CLI::App& verb, SimulationFlags& flags) {
  verb.add_flag("--by-bounce", flags.by_bounce, "Store a matrix for each number of bounces, too")
      ->needs("--max-bounces");
  verb.add_option("--by-length", flags.by_length,
                  "Store a matrix for each step of so many metres of path length, too (uniform)")
      ->check(positive_number());
  verb.add_option("--lengths", flags.lengths,
                  fmt::format("Number of these steps; the last takes all longer paths ({})", default_lengths))
      ->check(CLI::Range(1, 10000))
      ->needs("--by-length");
}

std::string describe(const SimulationSummary& summary) {
  const std::string samples = summary.least_samples == summary.most_samples
                                  ? fmt::format("{}", summary.least_samples)
                                  : fmt::format("{} to {}", summary.least_samples, summary.most_samples);
  std::string text =
      fmt::format("{} labels x {} candidates, {} samples a label in {:.1f} s ({:.2f} million rays a second)",
                  summary.labels, summary.candidates, samples, summary.seconds,
                  static_cast<double>(summary.rays) / summary.seconds / 1e6);
  if (exceeds_what_was_asked(summary))
    text +=
        fmt::format("\n{} samples per label instead of {}: at least {} batches are needed to estimate errors",
                    samples, *summary.asked_samples, least_batches);
  if (summary.resumed_batches > 0)
    text += fmt::format("\nwent on from the checkpoint, which had {} of the {} batches",
                        summary.resumed_batches, summary.batches);
  for (const ErrorQuantiles& errors : summary.errors) {
    if (errors.entries == 0)
      text += fmt::format("\nno entry exceeds {} of its requirement", errors.above);
    else
      text += fmt::format(
          "\nrelative standard error of the {} entries above {} of the requirement: median {:.1f} %, "
          "90 % below {:.1f} %, 99 % below {:.1f} %",
          errors.entries, errors.above, 100 * errors.median, 100 * errors.p90, 100 * errors.p99);
    if (errors.flagged > 0) text += fmt::format("; {} of them flagged", errors.flagged);
  }
  if (std::any_of(summary.errors.begin(), summary.errors.end(),
                  [](const ErrorQuantiles& errors) { return errors.flagged > 0; }))
    text +=
        "\nflagged: few batches found most of the light, so the error is not to be trusted; take more "
        "samples, or see in '/flags' of the signal file which entries they are";
  if (summary.unmet_error) {
    text += fmt::format(
        "\na relative error of {:g} % is out of reach of --max-samples for {} entries; "
        "{} fall short of it so far, the worst:",
        100 * *summary.unmet_error, summary.out_of_reach, summary.unmet);
    for (const UnmetEntry& entry : summary.worst_unmet)
      text += fmt::format("\n  label '{}' from '{}': {:.1f} %{}{}", entry.label, entry.source,
                          100 * entry.relative_error, entry.is_flagged ? ", flagged" : "",
                          entry.is_out_of_reach ? ", out of reach" : "");
  }
  return text + fmt::format("\nhalf these errors would take another {:.0f} s", summary.seconds_to_halve);
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
  if (summary.asked_samples) asked = *summary.asked_samples;
  return {{"labels", summary.labels},
          {"transceivers", summary.candidates},
          {"complete", summary.complete},
          {"samples", {summary.least_samples, summary.most_samples}},
          {"asked", asked},
          {"batches", {summary.least_batches, summary.most_batches}},
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
