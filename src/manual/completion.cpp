#include "completion.hpp"

#include <fmt/format.h>

namespace shelfbeam::manual {

namespace {

std::vector<std::string> names_of(const std::vector<Command>& verbs) {
  std::vector<std::string> names;
  names.reserve(verbs.size());
  for (const Command& verb : verbs) names.push_back(verb.name);
  return names;
}

std::vector<std::string> names_of(const std::vector<Argument>& options) {
  std::vector<std::string> names;
  for (const Argument& option : options) names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

// Inside single quotes, of a specification of zsh's _arguments.
std::string in_brackets(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return result;
}

std::string value_for_zsh(const Argument& argument) {
  if (argument.value.empty()) return {};
  if (argument.choices.empty()) return ":value:_files";
  return fmt::format(":value:({})", fmt::join(argument.choices, " "));
}

std::string option_for_zsh(const Argument& argument) {
  const std::string rest =
      fmt::format("'[{}]{}'", in_brackets(argument.description), value_for_zsh(argument));
  if (argument.names.size() == 1) return argument.names.front() + rest;
  return fmt::format("'({})'{{{}}}{}", fmt::join(argument.names, " "), fmt::join(argument.names, ","), rest);
}

}  // namespace

std::string bash_completion(const Program& program) {
  std::string values, options, positionals;
  for (const Command& verb : program.verbs) {
    for (const Argument& option : verb.options) {
      if (option.value.empty()) continue;
      for (const std::string& name : option.names)
        values += option.choices.empty() ? fmt::format("    '{} {}') return ;;\n", verb.name, name)
                                         : fmt::format("    '{} {}') choose '{}'; return ;;\n", verb.name,
                                                       name, fmt::join(option.choices, " "));
    }
    options += fmt::format("      {}) choose '{}' ;;\n", verb.name, fmt::join(names_of(verb.options), " "));
    for (const Argument& positional : verb.positionals)
      if (!positional.choices.empty())
        positionals += fmt::format("      '{} {}') choose '{}' ;;\n", verb.name, verb.name,
                                   fmt::join(positional.choices, " "));
  }
  return fmt::format(R"(# bash completion of {0}; made from the definition of its command line.
_{0}() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} verb=${{COMP_WORDS[1]-}}
  choose() {{ mapfile -t COMPREPLY < <(compgen -W "$1" -- "$word"); }}
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    choose '{1} {2}'
    return
  fi
  case "$verb ${{COMP_WORDS[COMP_CWORD - 1]}}" in
{3}  esac
  if [[ $word == -* ]]; then
    case "$verb" in
{4}    esac
  else
    case "$verb ${{COMP_WORDS[COMP_CWORD - 1]}}" in
{5}    esac
  fi
}}
complete -o default -F _{0} {0}
)",
                     program.self.name, fmt::join(names_of(program.verbs), " "),
                     fmt::join(names_of(program.self.options), " "), values, options, positionals);
}

std::string zsh_completion(const Program& program) {
  std::string verbs, cases;
  for (const Command& verb : program.verbs) {
    verbs += fmt::format("    '{}:{}'\n", verb.name, in_brackets(verb.summary));
    cases += fmt::format("    {})\n      _arguments", verb.name);
    for (const Argument& option : verb.options) cases += " \\\n        " + option_for_zsh(option);
    for (const Argument& positional : verb.positionals)
      cases += fmt::format(
          " \\\n        '{}:{}'", in_brackets(positional.names.front()),
          positional.choices.empty() ? "_files" : fmt::format("({})", fmt::join(positional.choices, " ")));
    cases += " \\\n        '*:file:_files'\n      ;;\n";
  }
  return fmt::format(R"(#compdef {0}
# zsh completion of {0}; made from the definition of its command line.
local -a verbs
verbs=(
{1})
if ((CURRENT == 2)); then
  _describe verb verbs
else
  local verb=$words[2]
  shift words
  ((CURRENT--))
  case $verb in
{2}  esac
fi
)",
                     program.self.name, verbs, cases);
}

}  // namespace shelfbeam::manual
