#pragma once

#include <stdexcept>
#include <string>

namespace shelfbeam {

/// The setting that an error refers to. The caller knows its name (a flag, a field of a form) and adds it to
/// the message.
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
  bounces
};

/// Wrong input: says what is wrong, where, and what to do about it.
///
/// `where` names the file and the place in it ("store.json: materials.wall.reflectance"). Nothing
/// has been written by then.
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

/// An output cannot be written: no permission, no room. What stood in its place is as it was.
class OutputError : public InputError {
 public:
  using InputError::InputError;
  /// The same with more to say at its end.
  OutputError(const OutputError& error, const std::string& addition, Setting setting)
      : InputError(static_cast<const InputError&>(error), addition, setting) {}
};

/// The user stopped the work before it had anything worth keeping.
class Interrupted : public std::runtime_error {
 public:
  explicit Interrupted(const std::string& text, Setting setting = Setting::none)
      : std::runtime_error(text), setting_(setting) {}

  Setting setting() const { return setting_; }

 private:
  Setting setting_;
};

}  // namespace shelfbeam
