#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam::bench {

/// The program of this build.
std::string this_program();

/// How a program ended.
struct Ended {
  int exit_code = 0;
  double cpu_seconds = 0;  ///< user and system, all its threads
};

/// Runs a program, by its path or by a name on the PATH, to its end. What it prints is thrown away, but for
/// errors. Safe to call from several threads. Throws std::runtime_error where it does not start, or a signal
/// ended it.
Ended run_program(std::vector<std::string> command);

/// What a program's `simulate` made of a store.
struct Simulated {
  SignalMatrix matrix;
  double cpu_seconds = 0;  ///< of the whole process: reading the store and writing the file as well
};

/// Runs `PROGRAM simulate STORE --seed SEED OPTIONS` on one thread. Throws std::runtime_error where it fails.
Simulated simulate_with(const std::string& program, const std::filesystem::path& store,
                        const std::vector<std::string>& options, std::uint64_t seed);

}  // namespace shelfbeam::bench
