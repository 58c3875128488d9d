#include "app/options/arguments.hpp"

#include <cstddef>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"

namespace shelfbeam::app {

namespace {

// The width of the help, for terminals of 80 columns, and of the first column of verbs.
constexpr std::size_t help_width = 80, verb_width = 12;

}  // namespace

HelpFormatter::HelpFormatter() {
  label("Positionals", "Arguments");
}

std::string HelpFormatter::make_usage(const CLI::App* app, std::string name) const {
  std::string text = fmt::format("Usage: {}", name);
  if (app->get_parent() == nullptr) return text + " VERB [OPTIONS]\n";
  for (const CLI::Option* option : app->get_options())
    if (option->get_positional()) text += " " + make_option_usage(option);
  for (const CLI::Option* option : app->get_options())
    if (option->get_required() && !option->get_positional())
      text += fmt::format(" -{}{}", option->get_snames().front(), make_option_opts(option));
  return text + " [OPTIONS]\n";
}

std::string HelpFormatter::make_subcommand(const CLI::App* verb) const {
  return fmt::format("  {:<{}}{}\n", verb->get_name(), verb_width - 2, verb->get_description());
}

std::string HelpFormatter::make_group(std::string name, bool is_positional,
                                      std::vector<const CLI::Option*> options) const {
  const std::string text = CLI::Formatter::make_group(name, is_positional, std::move(options));
  return is_positional || name == "Options" ? text : text.substr(1);  // CLI11 adds a second blank line
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
  return option->get_option_text().empty() ? std::string() : " " + option->get_option_text();
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
  const std::size_t width = help_width - get_column_width();
  std::istringstream words(option->get_description());
  std::string text, word;
  for (std::size_t length = 0; words >> word; length += word.size() + 1) {
    if (length + word.size() > width) {
      text += '\n';
      length = 0;
    } else if (length > 0) {
      text += ' ';
    }
    text += word;
  }
  return text;
}

void add_store_options(CLI::App& verb, bool& allow_outside) {
  OptionGroup(verb, group::runs)
      .add_flag("--allow-outside", allow_outside,
                "Allow the store file to name files (meshes, tables, profiles) outside its folder");
}

void add_strict_option(CLI::App& verb, bool& strict) {
  OptionGroup(verb, group::runs).add_flag("--strict", strict, "Treat warnings about the store as errors");
}

CLI::Option* add_safe_csv(CLI::App& verb, bool& safe_csv) {
  return OptionGroup(verb, group::runs)
      .add_flag("--safe-csv", safe_csv,
                "In CSV files, write an apostrophe before ids and names that a spreadsheet would take for "
                "formulas");
}

void add_common_options(CLI::App& verb, CommonOptions& options) {
  const OptionGroup runs(verb, group::runs);
  runs.add("--seed", options.seed, whole_number("N", 0),
           fmt::format("Seed of the random numbers; default {}", options.seed));
  runs.add("--threads", options.threads, whole_number("N", 0, 256),
           "Number of threads; default: one per core");
  runs.add_flag("--quiet", options.quiet, "Print errors only");
  runs.add_flag("--json", options.json, "Print the summary as JSON");
}

}  // namespace shelfbeam::app
