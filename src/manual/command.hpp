#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace shelfbeam::manual {

/// An option or a positional argument of a verb, as its definition has it.
struct Argument {
  std::vector<std::string> names;    ///< "-o", "--output"; of a positional its only name, such as "STORE"
  std::string description;           ///< a sentence or two
  std::string value;                 ///< what it takes, such as "FLOAT"; empty: a flag
  std::vector<std::string> choices;  ///< the only values there are; empty: any
  std::string fallback;              ///< its value where it is not given; may be empty
  bool required = false;
};

struct Command {
  std::string name;     ///< "plan"
  std::string summary;  ///< one line
  std::vector<Argument> positionals, options;
  std::string footer;  ///< examples
};

/// The program with its own options, and the verbs in the order in which they were added.
struct Program {
  Command self;
  std::string version;
  std::vector<Command> verbs;
};

Program describe(const CLI::App& app, std::string version);

}  // namespace shelfbeam::manual
