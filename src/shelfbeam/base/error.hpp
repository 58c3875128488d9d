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

 private:
  std::string where_;
};

/// The user stopped the work before it had anything worth keeping. Exit code 3.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace shelfbeam
