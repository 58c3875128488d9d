#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "reader.hpp"

namespace shelfbeam::fuzz {

/// What a sample came to.
struct Sample {
  std::size_t inputs = 0;
  std::size_t read = 0;  ///< of these, not refused
  std::string finding;   ///< empty, or the exception that is no InputError, or that the time was up
  std::string input;     ///< that led to it
};

/// Reads every seed and then so many changed ones, the same for the same `seed`, without a coverage-guided
/// fuzzer; ends at the first finding. A single input that takes longer than `longest_s` is one.
Sample sample(const Reader& reader, std::size_t changed, std::uint64_t seed, double longest_s = 20);

}  // namespace shelfbeam::fuzz
