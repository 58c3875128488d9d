#pragma once

#include <stdexcept>

#include <CLI/CLI.hpp>

namespace shelfbeam::app {

/// The command line cannot be understood. The message states the problem and a remedy.
class WrongUsage : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Parses the arguments of `main`. Without arguments, "help" and "help VERB" ask for help like --help. Throws
/// CLI::Success if help or the version is wanted, and WrongUsage.
void parse_command_line(CLI::App& app, int argc, const char* const* argv);

}  // namespace shelfbeam::app
