#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "shelfbeam/base/names.hpp"

namespace shelfbeam::app {

// What arguments of the command line must be, for CLI::Option::check; the messages name the option.

/// A finite number above 0.
CLI::Validator positive_number();
/// A whole number above 0 that fits its type.
CLI::Validator positive_count();
/// A path that is not empty.
CLI::Validator a_path();

/// An option or argument that is one.
CLI::Option* add_path(CLI::App& verb, const std::string& name, std::filesystem::path& path,
                      const std::string& help);

/// An option whose words are the names of an enumeration (names_of).
template <class Enum, class Value>
CLI::Option* add_names(CLI::App& verb, const std::string& flag, Value& value, const std::string& help) {
  const auto set = [&value](const std::string& name) { value = from_text<Enum>(name).value(); };
  return verb.add_option_function<std::string>(flag, set, help)->check(CLI::IsMember(all_names<Enum>()));
}
template <class Enum>
CLI::Option* add_choice(CLI::App& verb, const std::string& flag, std::optional<Enum>& value,
                        const std::string& help) {
  return add_names<Enum>(verb, flag, value, help);
}
/// As above, with what `value` is as the default.
template <class Enum>
CLI::Option* add_choice(CLI::App& verb, const std::string& flag, Enum& value, const std::string& help) {
  return add_names<Enum>(verb, flag, value, help)->default_str(std::string(to_text(value)));
}

/// Throws InputError when the output is the input, which it would overwrite.
void keep_input(const std::filesystem::path& output, const std::filesystem::path& input);

/// Throws InputError where the output cannot be written: now, not after an hour's work.
void expect_writable(const std::filesystem::path& output);

}  // namespace shelfbeam::app
