#include "placement_classes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/answer/placement.hpp"

#include "random_covers.hpp"
#include "support.hpp"

namespace shelfbeam::bench {

namespace {

constexpr PlacementProblem weighted{.model = CommunicationModel::non_cooperative,
                                    .combination = Combination::weighted};

struct Run {
  Placement found;
  double seconds = 0;
};

Run run(const SignalTable& table, const PlaceOptions& options) {
  Run one;
  one.seconds = cpu_seconds([&] { one.found = place(table, weighted, options, {.threads = 1}); });
  return one;
}

// Ties are left open: solvers do not settle them.
std::vector<PlaceOptions> entrants(double limit) {
  std::vector<PlaceOptions> all = {{.time_limit_s = limit, .settles_ties = false}};
  for (const milp::Backend& backend : milp::backends())
    all.push_back({.solver = SolverChoice::mip, .backend = std::string(backend.name), .time_limit_s = limit});
  return all;
}

std::string name_of(const PlaceOptions& options) {
  return options.backend.empty() ? "shelfbeam" : options.backend;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

}  // namespace

void compare_classes(std::size_t seeds, double limit) {
  fmt::print("{:<18}", "class");
  for (const PlaceOptions& options : entrants(limit)) fmt::print(" {:>10} {:>7}", name_of(options), "proven");
  fmt::print(" {:>12}\n", "to the faster");
  for (const CoverClass& one : dense_classes()) {
    fmt::print("{:<18}", one.name);
    std::vector<double> medians;
    std::vector<double> values(seeds, 0.0);
    for (const PlaceOptions& options : entrants(limit)) {
      std::vector<double> seconds;
      std::size_t proven = 0;
      for (std::size_t seed = 0; seed < seeds; ++seed) {
        const Run of_seed = run(random_cover(one, seed + 1), options);
        const bool is_proven = of_seed.found.status == Status::optimal;
        seconds.push_back(is_proven ? of_seed.seconds : std::numeric_limits<double>::infinity());
        proven += is_proven ? 1 : 0;
        if (medians.empty())
          values[seed] = is_proven ? of_seed.found.objective_value : 0;
        else if (is_proven && values[seed] > 0 && of_seed.found.objective_value != values[seed])
          fmt::print(" [seed {}: {} and {}]", seed + 1, values[seed], of_seed.found.objective_value);
      }
      medians.push_back(median(seconds));
      fmt::print(" {:>8.3f} s {:>2} of {:>2}", medians.back(), proven, seeds);
      std::fflush(stdout);
    }
    const double faster = *std::min_element(medians.begin() + 1, medians.end());
    fmt::print(" {:>13}\n", std::isfinite(faster) ? fmt::format("{:.2f}", medians[0] / faster) : "-");
    std::fflush(stdout);
  }
}

void compare_wide(double limit) {
  const CoverClass wide = wide_class();
  const SignalTable table = random_cover(wide, 1);
  for (const PlaceOptions& options : entrants(limit)) {
    const Run one = run(table, options);
    fmt::print("{:<14} {:<10} value {:>6} bound {:>9.6g} {:>10.1f} s CPU {:>8.1f} s\n", wide.name,
               name_of(options), one.found.objective_value, one.found.lower_bound, one.seconds,
               one.found.seconds);
    std::fflush(stdout);
  }
}

}  // namespace shelfbeam::bench
