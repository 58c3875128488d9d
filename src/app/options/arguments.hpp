#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "shelfbeam/base/names.hpp"

#include "app/options/values.hpp"

namespace shelfbeam::app {

/// The groups of options in --help after the first group, which contains the options that most users need.
namespace group {
inline constexpr auto simulation = "Simulation", placement = "Placement", certificate = "Certificate",
                      states = "Changing shop", cluster = "Many machines", runs = "Files and runs";
}

/// Prints the option_text of an option instead of its type and limits, shows arguments and required options
/// in the usage, wraps at 80 columns, and separates groups by one blank line.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter();
  std::string make_usage(const CLI::App* app, std::string name) const override;
  std::string make_subcommand(const CLI::App* verb) const override;
  std::string make_group(std::string name, bool is_positional,
                         std::vector<const CLI::Option*> options) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_option_desc(const CLI::Option* option) const override;
};

/// An option or argument that is a path.
CLI::Option* add_path(CLI::App& verb, const std::string& name, std::filesystem::path& path,
                      const std::string& help);

/// The values of an option as its option_text: "{a,b}".
std::string choices(const std::vector<std::string>& names);

/// An option whose values are the names of an enumeration (names_of).
template <class Enum, class Value>
CLI::Option* add_names(CLI::App& verb, const std::string& flag, Value& value, const std::string& help) {
  const auto set = [&value](const std::string& name) { value = from_text<Enum>(name).value(); };
  const std::vector<std::string> names = all_names<Enum>();
  return verb.add_option_function<std::string>(flag, set, help)
      ->check(one_of(names))
      ->option_text(choices(names));
}
template <class Enum>
CLI::Option* add_choice(CLI::App& verb, const std::string& flag, std::optional<Enum>& value,
                        const std::string& help) {
  return add_names<Enum>(verb, flag, value, help);
}
template <class Enum>
CLI::Option* add_choice(CLI::App& verb, const std::string& flag, Enum& value, const std::string& help) {
  return add_names<Enum>(verb, flag, value, help);
}

/// Throws InputError if the output would overwrite the input.
void protect_input(const std::filesystem::path& output, const std::filesystem::path& input);

/// Throws InputError if the output cannot be written, before any long work begins.
void expect_writable(const std::filesystem::path& output);

}  // namespace shelfbeam::app
