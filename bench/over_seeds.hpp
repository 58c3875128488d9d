#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace shelfbeam::bench {

/// Programs are run as their users run them, once a seed, and their files compared.
struct OverSeeds {
  std::vector<std::string> stores;
  std::uint64_t seeds = 8;
  std::uint64_t samples = 4192;  ///< per label and run; of path reuse 32 batches
  std::uint64_t reference_samples = 4000000;
};

/// Prints how the default estimator of this build compares with that of an earlier `program`.
void compare_with_program(const OverSeeds& settings, const std::string& program);

/// Prints how the default estimator of this build compares with the paper's of the same build, by their
/// distances from a long run of the latter.
void compare_with_paper(const OverSeeds& settings);

}  // namespace shelfbeam::bench
