#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam::bench {

/// The program of this build.
std::string this_program();

/// The end of a program.
struct Ended {
  int exit_code = 0;
  double cpu_seconds = 0;  ///< user and system time of all threads
};

/// Runs a program, given by its path or by a name on the PATH, to its end. Discards its standard output. Safe
/// to call from several threads. Throws std::runtime_error if it does not start, or a signal ended it.
Ended run_program(std::vector<std::string> command);

/// The result of a program's `simulate`.
struct Simulated {
  SignalMatrix matrix;
  double cpu_seconds = 0;  ///< of the whole process, including reading the store and writing the file
};

/// Runs `PROGRAM simulate STORE --seed SEED OPTIONS` on one thread. Throws std::runtime_error if it fails.
Simulated simulate_with(const std::string& program, const std::filesystem::path& store,
                        const std::vector<std::string>& options, std::uint64_t seed);

}  // namespace shelfbeam::bench
