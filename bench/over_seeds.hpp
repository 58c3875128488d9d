#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace shelfbeam::bench {

/// Runs programs as users do, once per seed, and compares their files.
struct OverSeeds {
  std::vector<std::string> stores;
  std::uint64_t seeds = 8;
  std::uint64_t samples = 4192;  ///< per label and run; 32 batches of path reuse
  std::uint64_t reference_samples = 4000000;
};

/// Prints a comparison of the default estimators of this build and of an earlier `program`.
void compare_with_program(const OverSeeds& settings, const std::string& program);

/// Prints a comparison of this build's default estimator with its implementation of the paper's and with
/// particles from the units, by their distances from a long run of the paper's.
void compare_with_paper(const OverSeeds& settings);

}  // namespace shelfbeam::bench
