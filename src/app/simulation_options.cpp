#include "simulation_options.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/report/sampling.hpp"

namespace shelfbeam::app {

SimulationOptions SimulationFlags::options(std::uint64_t seed) const {
  return {samples, direct == "sampled" ? DirectLight::sampled : DirectLight::exact, seed};
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
  verb.add_option("--samples", flags.samples, "First rays a label, dealt out over 32 batches")
      ->check(CLI::Range(std::uint64_t{64}, std::uint64_t{1} << 36))
      ->capture_default_str();
}

void expect_memory_for(const Scene& scene, const std::filesystem::path& store) {
  // An entry is summed up in three doubles and written as three floats.
  constexpr double bytes_per_entry = 3 * sizeof(double) + 3 * sizeof(float);
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
