#include "command.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace shelfbeam::manual {

namespace {

// "TEXT:{reuse,uniform}" has two choices.
std::vector<std::string> choices_of(const std::string& type) {
  std::vector<std::string> choices;
  const auto open = type.find('{'), close = type.find('}');
  if (open == std::string::npos || close == std::string::npos) return choices;
  std::string inside = type.substr(open + 1, close - open - 1);
  for (std::size_t begin = 0; begin <= inside.size();) {
    const std::size_t end = std::min(inside.find(',', begin), inside.size());
    choices.push_back(inside.substr(begin, end - begin));
    begin = end + 1;
  }
  return choices;
}

Argument argument_of(const CLI::Option& option) {
  Argument argument;
  if (option.nonpositional()) {
    for (const std::string& name : option.get_snames()) argument.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) argument.names.push_back("--" + name);
  } else {
    argument.names = {option.get_name(true)};
  }
  argument.description = option.get_description();
  if (option.get_items_expected_max() > 0) {
    const std::string type = option.get_type_name();
    argument.choices = choices_of(type);
    argument.value = type.substr(0, type.find_first_of(":[ "));
  }
  argument.fallback = option.get_default_str();
  argument.required = option.get_required();
  return argument;
}

Command command_of(const CLI::App& app) {
  Command command{app.get_name(), app.get_description(), {}, {}, app.get_footer()};
  for (const CLI::Option* option : app.get_options())
    (option->nonpositional() ? command.options : command.positionals).push_back(argument_of(*option));
  return command;
}

}  // namespace

Program describe(const CLI::App& app, std::string version) {
  Program program{command_of(app), std::move(version), {}};
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    program.verbs.push_back(command_of(*verb));
  return program;
}

}  // namespace shelfbeam::manual
