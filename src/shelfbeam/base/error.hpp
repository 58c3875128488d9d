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
  failure,
  estimator,
  strategy,
  direct_light,
  bounces,
  strictness,
  overwriting,
  part,
  signals
};

/// Wrong input. The message states the location, the problem and a suggestion.
///
/// `where` names the file and the location in it ("store.json: materials.wall.reflectance"). Nothing has been
/// written when this is thrown.
class InputError : public std::runtime_error {
 public:
  InputError(const std::string& where, const std::string& problem, const std::string& suggestion = {},
             Setting setting = Setting::none)
      : std::runtime_error((where.empty() ? "" : where + ": ") + problem +
                           (suggestion.empty() ? "" : "; " + suggestion)),
        where_(where),
        setting_(setting) {}

  const std::string& where() const { return where_; }
  Setting setting() const { return setting_; }

 protected:
  InputError(const InputError& error, const std::string& addition, Setting setting)
      : std::runtime_error(error.what() + ("; " + addition)), where_(error.where_), setting_(setting) {}

 private:
  std::string where_;
  Setting setting_;
};

/// An output cannot be written (no permission, full disk). An older file of that name is unchanged.
class OutputError : public InputError {
 public:
  using InputError::InputError;
  /// The same error with `addition` at the end of its message.
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
