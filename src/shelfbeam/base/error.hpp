#pragma once

#include <array>
#include <stdexcept>
#include <string>

#include "shelfbeam/base/names.hpp"

namespace shelfbeam {

/// The setting that an error refers to. The caller knows the setting's name (a flag, a field of a form) and
/// adds the name to the message.
enum class Setting {
  none,
  memory,
  files_outside,
  resumption,
  requirement,
  forbidden_pairs,
  share,
  units,
  share_of_labels,
  failure,
  estimator,
  strategy,
  heuristic,
  direct_light,
  bounces,
  lengths,
  relative_error,
  strictness,
  overwriting,
  overwriting_with_reuse,
  part,
  reading,
  curve,
  sensitivity,
  objective,
  availability,
  all_at_once,
  mean_missed,
  sampled,
  budget,
  time_limit,
  solver,
  pinned,
  excluded,
  without
};

/// Short names of the settings ("max-bounces"), from which each caller makes its own; none and
/// overwriting_with_reuse have none.
template <>
inline constexpr auto names_of<Setting> =
    std::to_array<Named<Setting>>({{"memory", Setting::memory},
                                   {"allow-outside", Setting::files_outside},
                                   {"resume", Setting::resumption},
                                   {"threshold", Setting::requirement},
                                   {"forbid", Setting::forbidden_pairs},
                                   {"share", Setting::share},
                                   {"at-most", Setting::units},
                                   {"reach", Setting::share_of_labels},
                                   {"survive-failure", Setting::failure},
                                   {"estimator", Setting::estimator},
                                   {"strategy", Setting::strategy},
                                   {"direct", Setting::direct_light},
                                   {"max-bounces", Setting::bounces},
                                   {"strict", Setting::strictness},
                                   {"overwrite", Setting::overwriting},
                                   {"part", Setting::part},
                                   {"read-as", Setting::reading},
                                   {"heuristic", Setting::heuristic},
                                   {"by-length", Setting::lengths},
                                   {"relative-error", Setting::relative_error},
                                   {"curve", Setting::curve},
                                   {"sensitivity", Setting::sensitivity},
                                   {"objective", Setting::objective},
                                   {"availability", Setting::availability},
                                   {"all-at-once", Setting::all_at_once},
                                   {"mean-missed", Setting::mean_missed},
                                   {"sampled", Setting::sampled},
                                   {"budget", Setting::budget},
                                   {"time-limit", Setting::time_limit},
                                   {"solver", Setting::solver},
                                   {"pin", Setting::pinned},
                                   {"exclude", Setting::excluded},
                                   {"without", Setting::without}});

/// Wrong input. The message states the location, the problem and a suggestion. It may quote any bytes of
/// names and files: characters that are not printable, and bytes that are not UTF-8, are escaped in it
/// ("\x00").
///
/// `where` names the file and the location in it ("store.json: materials.wall.reflectance"). Nothing has been
/// written when this is thrown.
class InputError : public std::runtime_error {
 public:
  InputError(const std::string& where, const std::string& problem, const std::string& suggestion = {},
             Setting setting = Setting::none);
  /// The same error with `addition` at the end of its message.
  InputError(const InputError& error, const std::string& addition, Setting setting);

  const std::string& where() const { return where_; }
  Setting setting() const { return setting_; }

 private:
  std::string where_;
  Setting setting_;
};

/// An output cannot be written (no permission, full disk). An older file of that name is unchanged.
class OutputError : public InputError {
 public:
  using InputError::InputError;
  OutputError(const OutputError& error, const std::string& addition, Setting setting)
      : InputError(static_cast<const InputError&>(error), addition, setting) {}
};

/// The user stopped the work before it had a result worth keeping.
class Interrupted : public std::runtime_error {
 public:
  explicit Interrupted(const std::string& text, Setting setting = Setting::none)
      : std::runtime_error(text), setting_(setting) {}

  Setting setting() const { return setting_; }

 private:
  Setting setting_;
};

}  // namespace shelfbeam
