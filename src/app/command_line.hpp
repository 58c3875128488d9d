#pragma once

#include <CLI/CLI.hpp>

#include "app/verbs.hpp"

namespace shelfbeam::app {

/// Names the program and adds every verb: all that there is to know of the command line, for those who parse
/// it and for those who describe it (src/manual). Parsing fills `chosen`, which must outlive `app`.
void define_command_line(CLI::App& app, ChosenVerb& chosen);

}  // namespace shelfbeam::app
