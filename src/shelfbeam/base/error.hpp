#pragma once

#include <stdexcept>
#include <string>

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
