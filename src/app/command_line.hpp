#pragma once

#include <CLI/CLI.hpp>

#include "app/verbs.hpp"

namespace shelfbeam::app {

/// Names the program and adds every verb. Parsing fills `chosen`, which must outlive `app`.
void define_command_line(CLI::App& app, ChosenVerb& chosen);

}  // namespace shelfbeam::app
