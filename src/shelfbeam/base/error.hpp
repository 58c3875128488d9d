#pragma once

#include <stdexcept>
#include <string>

namespace shelfbeam {

/// Wrong input: says what is wrong, where, and what to do about it.
///
/// `where` names the file and the place in it ("store.json: materials.wall.reflectance"). The command line
/// turns this error into one line on standard error and exit code 2; nothing has been written by then.
class InputError : public std::runtime_error {
 public:
  InputError(const std::string& where, const std::string& problem, const std::string& suggestion = {});

  const std::string& where() const { return where_; }

 protected:
  InputError(const InputError& error, const std::string& addition);

 private:
  std::string where_;
};

/// An output cannot be written: no permission, no room. What stood in its place is as it was.
class OutputError : public InputError {
 public:
  using InputError::InputError;
  /// The same with more to say at its end.
  OutputError(const OutputError& error, const std::string& addition);
};

/// The user stopped the work before it had anything worth keeping. Exit code 3.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace shelfbeam
