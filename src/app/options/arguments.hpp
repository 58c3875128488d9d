#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "shelfbeam/base/names.hpp"

#include "app/options/values.hpp"
#include "app/verbs.hpp"

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

/// A group of options in the --help of a verb. Without a name: the first group.
class OptionGroup {
 public:
  explicit OptionGroup(CLI::App& verb, std::string name = "Options") : verb_(verb), name_(std::move(name)) {}

  /// An option or argument whose values `kind` reads; the help shows its description as the value.
  template <class Value>
  CLI::Option* add(const std::string& flag, Value& value, const CLI::Validator& kind,
                   const std::string& help) const {
    return of_kind(verb_.add_option(flag, value, help), kind);
  }
  /// One that must be given.
  template <class Value>
  void require(const std::string& flag, Value& value, const CLI::Validator& kind,
               const std::string& help) const {
    add(flag, value, kind, help)->required();
  }
  template <class Value>
  CLI::Option* add_call(const std::string& flag, const std::function<void(const Value&)>& set,
                        const CLI::Validator& kind, const std::string& help) const {
    return of_kind(verb_.add_option_function<Value>(flag, set, help), kind);
  }
  /// The values are the names of an enumeration (names_of).
  template <class Enum, class Value>
  CLI::Option* add_names(const std::string& flag, Value& value, const std::string& help) const {
    return add_call<std::string>(
        flag, [&value](const std::string& name) { value = from_text<Enum>(name).value(); },
        one_of(all_names<Enum>()), help);
  }
  template <class Enum>
  CLI::Option* add_choice(const std::string& flag, std::optional<Enum>& value,
                          const std::string& help) const {
    return add_names<Enum>(flag, value, help);
  }
  template <class Enum>
  CLI::Option* add_choice(const std::string& flag, Enum& value, const std::string& help) const {
    return add_names<Enum>(flag, value, help);
  }
  CLI::Option* add_flag(const std::string& flag, bool& value, const std::string& help) const {
    return verb_.add_flag(flag, value, help)->group(name_);
  }
  CLI::Option* add_flag_call(const std::string& flag, const std::function<void()>& set,
                             const std::string& help) const {
    return verb_.add_flag_callback(flag, set, help)->group(name_);
  }
  /// A file that may be given several times.
  CLI::Option* add_files(const std::string& flag, std::vector<std::filesystem::path>& files,
                         const std::string& help) const {
    return add(flag, files, a_path("FILE"), help)->allow_extra_args(false);
  }

 private:
  CLI::Option* of_kind(CLI::Option* option, const CLI::Validator& kind) const {
    return option->transform(kind)->option_text(kind.get_description())->group(name_);
  }

  CLI::App& verb_;
  std::string name_;
};

// Options that several verbs have.

/// --allow-outside.
void add_store_options(CLI::App& verb, bool& allow_outside);
/// --strict.
void add_strict_option(CLI::App& verb, bool& strict);
/// --safe-csv.
CLI::Option* add_safe_csv(CLI::App& verb, bool& safe_csv);
void add_common_options(CLI::App& verb, CommonOptions& options);

/// Adds the options of all verbs and the examples to a verb that is otherwise complete.
template <class Arguments>
void finish_verb(CLI::App& verb, ChosenVerb& chosen, const std::shared_ptr<Arguments>& options,
                 int (*run)(const Arguments&), const std::string& examples) {
  add_common_options(verb, options->common);
  verb.footer(examples);
  verb.callback([options, run, &chosen] { chosen = [options, run] { return run(*options); }; });
}

}  // namespace shelfbeam::app
