#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "reader.hpp"

namespace shelfbeam::fuzz {

/// The result of a sample.
struct Sample {
  std::size_t inputs = 0;
  std::size_t read = 0;  ///< inputs that were not refused
  std::string finding;   ///< an exception other than InputError, or a timeout; empty without a finding
  std::string input;     ///< the input of the finding
};

/// Reads every seed file and then `changed` mutated ones, without a coverage-guided fuzzer; equal `seed`s
/// give equal inputs. Ends at the first finding. An input that takes longer than `longest_s` is a finding,
/// too.
Sample sample(const Reader& reader, std::size_t changed, std::uint64_t seed, double longest_s = 20);

}  // namespace shelfbeam::fuzz
