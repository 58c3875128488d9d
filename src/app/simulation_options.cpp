#include "simulation_options.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/report/sampling.hpp"

namespace shelfbeam::app {

SimulationOptions SimulationFlags::options(std::uint64_t seed) const {
  SimulationOptions options;
  options.samples = samples;
  options.direct = direct == "sampled" ? DirectLight::sampled : DirectLight::exact;
  options.seed = seed;
  options.strategy = strategy == "walk"  ? Strategy::walk
                     : strategy == "nee" ? Strategy::nee
                     : strategy == "mis" ? Strategy::mis
                                         : Strategy::particle;
  options.heuristic = heuristic == "balance" ? Heuristic::balance : Heuristic::power;
  options.max_bounces = max_bounces.value_or(PathRules::no_limit);
  options.by_bounce = by_bounce;
  return options;
}

void add_simulation_options(CLI::App& verb, SimulationFlags& flags, const std::string& default_direct) {
  flags.direct = default_direct;
  verb.add_option("--estimator", flags.estimator,
                  "uniform: the paper's random walk with one uniformly chosen transceiver a vertex")
      ->check(CLI::IsMember({"uniform"}))
      ->capture_default_str();
  verb.add_option("--direct", flags.direct,
                  "Direct light: sampled by the walk, as in the paper, or exact in closed form")
      ->check(CLI::IsMember({"sampled", "exact"}))
      ->capture_default_str();
  verb.add_option("--samples", flags.samples,
                  "First rays a label (particles a transceiver), dealt out over 32 batches")
      ->check(CLI::Range(std::uint64_t{64}, std::uint64_t{1} << 36))
      ->capture_default_str();
  verb.add_option("--strategy", flags.strategy,
                  "How paths are found: walk (until a transceiver of some size is met), nee (next event "
                  "estimation), mis (both, weighted), particle (from the transceivers)")
      ->check(CLI::IsMember({"walk", "nee", "mis", "particle"}))
      ->capture_default_str();
  verb.add_option("--heuristic", flags.heuristic, "Weights of mis")
      ->check(CLI::IsMember({"balance", "power"}))
      ->capture_default_str();
  verb.add_option("--max-bounces", flags.max_bounces, "Longest paths: reflections and refractions")
      ->check(CLI::Range(0, 1000));
}

void add_by_bounce(CLI::App& verb, SimulationFlags& flags) {
  verb.add_flag("--by-bounce", flags.by_bounce, "Store a matrix for each number of bounces, too")
      ->needs("--max-bounces");
}

void expect_memory_for(const Scene& scene, const SimulationOptions& options,
                       const std::filesystem::path& store) {
  // An entry is summed up in three doubles and written as three floats; a layer of bounces is two of either.
  const double layers = options.by_bounce ? options.max_bounces + 1.0 : 0;
  const double bytes_per_entry = (3 + 2 * layers) * (sizeof(double) + sizeof(float));
  const double needed = bytes_per_entry * static_cast<double>(scene.labels.size()) *
                        static_cast<double>(scene.transceivers.size());
  const double present =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  if (needed > present)
    throw InputError(
        store.string(),
        fmt::format(
            "has {} labels and {} candidates, whose matrix takes {:.1f} GB; this machine has {:.1f} GB",
            scene.labels.size(), scene.transceivers.size(), needed / 1e9, present / 1e9),
        "use a wider grid of candidates");
}

std::string describe(const SimulationResult& result) {
  const SamplingSummary sampling = sampling_summary(result.matrix);
  std::string text = fmt::format(
      "{} labels x {} candidates, {} samples a label in {:.1f} s ({:.2f} million rays a second)\n",
      result.matrix.rows(), result.matrix.columns(), sampling.least_samples, result.seconds,
      static_cast<double>(result.rays) / result.seconds / 1e6);
  if (sampling.relevant == 0)
    return text + fmt::format("no entry reaches {} of its requirement", relevant_share);
  return text + fmt::format(
                    "relative standard error of the {} entries above {} of the requirement: "
                    "median {:.1f} %, 99 % below {:.1f} %",
                    sampling.relevant, relevant_share, 100 * sampling.median, 100 * sampling.p99);
}

}  // namespace shelfbeam::app
