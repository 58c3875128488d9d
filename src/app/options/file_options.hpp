#pragma once

#include <CLI/CLI.hpp>

namespace shelfbeam::app {

/// --allow-outside.
void add_store_options(CLI::App& verb, bool& allow_outside);
/// --strict.
void add_strict_option(CLI::App& verb, bool& strict);
/// --safe-csv.
CLI::Option* add_safe_csv(CLI::App& verb, bool& safe_csv);

}  // namespace shelfbeam::app
