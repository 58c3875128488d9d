#include "app/options/usage.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/base/text.hpp"

namespace shelfbeam::app {

namespace {

using Words = std::vector<std::string>;

std::vector<const CLI::App*> verbs_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

// Null if the command line names no verb.
const CLI::App* chosen_verb(const CLI::App& app) {
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  return chosen.empty() ? nullptr : chosen.front();
}

bool is_option(std::string_view word) {
  return word.size() > 1 && word[0] == '-' && word != "--";
}

// "--samples" of "--samples=100".
std::string without_value(std::string_view word) {
  return std::string(word.substr(0, word.find('=')));
}

// The long options of a verb, without their dashes.
Words long_names(const CLI::App& verb) {
  Words names;
  for (const CLI::Option* option : verb.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back(name);
  return names;
}

// The option of the verb that a wrong word begins or resembles, without its dashes; else empty.
std::string near_option(const CLI::App& verb, std::string_view word) {
  word.remove_prefix(std::min(word.find_first_not_of('-'), word.size()));
  const Words names = long_names(verb);
  Words begun;
  for (const std::string& name : names)
    if (word.size() > 1 && name.starts_with(word)) begun.push_back(name);
  return begun.size() == 1 ? begun.front()
                           : nearest(word, std::vector<std::string_view>(names.begin(), names.end()));
}

// "'plan' and 'verify'": the verbs that have this option; empty if none does.
std::string owners_of(const CLI::App& app, const std::string& option) {
  Words owners;
  for (const CLI::App* verb : verbs_of(app))
    if (verb->get_option_no_throw(option) != nullptr) owners.push_back(fmt::format("'{}'", verb->get_name()));
  if (owners.empty()) return {};
  const std::string last = owners.back();
  owners.pop_back();
  return owners.empty() ? last : fmt::format("{} and {}", fmt::join(owners, ", "), last);
}

std::string see_help(const CLI::App* verb) {
  return fmt::format("; see 'shelfbeam{} --help'", verb == nullptr ? "" : " " + verb->get_name());
}

std::string unknown_option(const CLI::App& app, const CLI::App* verb, const std::string& word) {
  const std::string option = without_value(word);
  if (verb != nullptr && verb->get_option_no_throw(option) != nullptr)
    return fmt::format("'{}' must follow the verb: shelfbeam {} ... {}", option, verb->get_name(), option);
  if (const std::string owners = owners_of(app, option); !owners.empty())
    return verb == nullptr
               ? fmt::format("'{}' belongs to {} and must follow the verb{}", option, owners, see_help(verb))
               : fmt::format("'{}' belongs to {}, not to '{}'{}", option, owners, verb->get_name(),
                             see_help(verb));
  const std::string near = near_option(verb == nullptr ? app : *verb, option);
  return fmt::format("unknown option '{}'{}", option,
                     near.empty() ? see_help(verb) : fmt::format("; did you mean '--{}'?", near));
}

std::string unknown_verb(const CLI::App& app, const std::string& word) {
  Words names;
  for (const CLI::App* verb : verbs_of(app)) names.push_back(verb->get_name());
  return fmt::format("unknown verb '{}'; {}", word,
                     suggest(word, std::vector<std::string_view>(names.begin(), names.end())));
}

// "-samples" is not the option -s with the value "amples".
std::optional<std::string> single_dash(const CLI::App& verb, const Words& arguments) {
  for (const std::string& word : arguments) {
    if (word == "--") break;
    const std::string option = without_value(word), meant = "-" + option;
    if (option.size() > 2 && is_option(word) && word[1] != '-' && verb.get_option_no_throw(meant) != nullptr)
      return fmt::format("unknown option '{}'; did you mean '{}'?", option, meant);
  }
  return std::nullopt;
}

// The first argument that the program does not know, and its remedy.
std::optional<std::string> unknown_argument(const CLI::App& app, const Words& arguments) {
  const CLI::App* verb = chosen_verb(app);
  if (verb == nullptr && !arguments.empty() && !is_option(arguments.front()))
    return unknown_verb(app, arguments.front());
  Words unknown = app.remaining();
  if (verb != nullptr) {
    if (auto problem = single_dash(*verb, arguments)) return problem;
    for (const std::string& word : verb->remaining()) unknown.push_back(word);
  }
  const auto first = [&](auto&& fits) -> const std::string* {
    for (const std::string& word : arguments)
      if (fits(word) && std::find(unknown.begin(), unknown.end(), word) != unknown.end()) return &word;
    return nullptr;
  };
  if (const std::string* option = first(is_option)) return unknown_option(app, verb, *option);
  const std::string* word = first([](const std::string&) { return true; });
  if (word == nullptr) return std::nullopt;
  return verb == nullptr ? unknown_verb(app, *word)
                         : fmt::format("unexpected argument '{}'{}", *word, see_help(verb));
}

// The first example in the help of a verb.
std::string example_of(const CLI::App& verb) {
  const std::string footer = verb.get_footer();
  const std::size_t begin = footer.find("  shelfbeam ");
  if (begin == std::string::npos) return {};
  return fmt::format("; for example: {}", trim(footer.substr(begin, footer.find('\n', begin) - begin)));
}

// CLI11's message in plain words.
std::string problem_of(const CLI::App* verb, const CLI::ParseError& error) {
  std::string text = error.what();
  const std::string name = text.substr(0, text.find(':'));
  const CLI::Option* option = verb == nullptr ? nullptr : verb->get_option_no_throw(name);
  if (option == nullptr || dynamic_cast<const CLI::ArgumentMismatch*>(&error) == nullptr) return text;
  const auto most = static_cast<std::size_t>(std::max(1, option->get_items_expected_max()));
  return option->count() > most ? name + " is given more than once"
                                : fmt::format("{}: {} is missing", name, option->get_option_text());
}

// The first file among the arguments that does not exist.
std::string missing_file(const CLI::App& verb) {
  std::error_code unknown;
  for (const CLI::Option* option : verb.get_options())
    if (const std::string& kind = option->get_option_text();
        option->get_positional() && (kind.starts_with("PATH") || kind.starts_with("FILE")))
      for (const std::string& path : option->results())
        if (!std::filesystem::exists(path, unknown)) return path;
  return {};
}

std::string usage_problem(const CLI::App& app, const CLI::ParseError& error, const Words& arguments) {
  const CLI::App* verb = chosen_verb(app);
  const bool is_required = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
  if (is_required || dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr)
    if (auto problem = unknown_argument(app, arguments)) return *problem;
  std::string problem = problem_of(verb, error);
  if (problem.ends_with('?')) return problem;  // a suggestion is remedy enough
  if (verb != nullptr && is_required)
    if (const std::string path = missing_file(*verb); !path.empty())
      problem = fmt::format("{}: does not exist, and {}", path, problem);
  return problem + (verb != nullptr && is_required ? example_of(*verb) : "") + see_help(verb);
}

// Nobody reads thousands of characters of an argument that is wrong.
std::string with_short_values(std::string text, const Words& arguments) {
  constexpr std::size_t longest = 60, shown = 40;
  for (const std::string& word : arguments) {
    const std::string value = word.substr(word.starts_with("--") ? word.find('=') + 1 : 0);
    if (value.size() <= longest) continue;
    const std::string start = shortened(value, shown);
    for (std::size_t at = text.find(value); at != std::string::npos; at = text.find(value, at))
      text.replace(at, value.size(), start);
  }
  return text;
}

}  // namespace

void parse_command_line(CLI::App& app, int argc, const char* const* argv) {
  Words arguments(argv + std::min(argc, 1), argv + argc);
  if (arguments.empty()) {
    arguments = {"--help"};
  } else if (arguments.front() == "help") {
    arguments.erase(arguments.begin());
    arguments.emplace_back("--help");
  }
  try {
    app.parse(Words(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::Success&) {
    if (chosen_verb(app) != nullptr || app.remaining().empty()) throw;
    throw WrongUsage(with_short_values(*unknown_argument(app, arguments), arguments));
  } catch (const CLI::ParseError& error) {
    throw WrongUsage(with_short_values(usage_problem(app, error, arguments), arguments));
  }
  if (auto problem = single_dash(*chosen_verb(app), arguments)) throw WrongUsage(*problem);
}

}  // namespace shelfbeam::app
