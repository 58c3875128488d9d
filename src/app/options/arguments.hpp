#pragma once

#include <filesystem>

#include <CLI/CLI.hpp>

namespace shelfbeam::app {

// What arguments of the command line must be, for CLI::Option::check; the messages name the option.

/// A finite number above 0.
CLI::Validator positive_number();
/// A whole number above 0 that fits its type.
CLI::Validator positive_count();
/// A path that is not empty.
CLI::Validator a_path();

/// Throws InputError when the output is the input, which it would overwrite.
void keep_input(const std::filesystem::path& output, const std::filesystem::path& input);

/// Throws InputError where the output cannot be written: now, not after an hour's work.
void expect_writable(const std::filesystem::path& output);

}  // namespace shelfbeam::app
