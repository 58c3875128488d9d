#include "simulation_options.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <unistd.h>

#include "shelfbeam/base/error.hpp"

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
  const SignalMatrix& matrix = result.matrix;
  std::vector<double> relative;
  for (std::size_t i = 0; i < matrix.rows(); ++i)
    for (std::size_t j = 0; j < matrix.columns(); ++j) {
      const std::size_t entry = matrix.at(i, j);
      if (static_cast<double>(matrix.mean[entry]) >= 0.3 * matrix.labels[i].requirement)
        relative.push_back(static_cast<double>(matrix.standard_error[entry] / matrix.mean[entry]));
    }
  std::string error = "no entry above 0.3 of its requirement";
  if (!relative.empty()) {
    std::sort(relative.begin(), relative.end());
    error = fmt::format(
        "relative standard error of the {} entries above 0.3 of the requirement: median {:.1f} %, "
        "99 % below {:.1f} %",
        relative.size(), 100 * relative[relative.size() / 2],
        100 * relative[static_cast<std::size_t>(0.99 * static_cast<double>(relative.size() - 1))]);
  }
  const auto fewest = std::min_element(matrix.labels.begin(), matrix.labels.end(),
                                       [](const auto& a, const auto& b) { return a.samples < b.samples; });
  return fmt::format(
      "{} labels x {} candidates, {} samples a label in {:.1f} s ({:.2f} million rays a second)\n{}",
      matrix.rows(), matrix.columns(), fewest->samples, result.seconds,
      static_cast<double>(result.rays) / result.seconds / 1e6, error);
}

}  // namespace shelfbeam::app
