#pragma once

#include <optional>
#include <string>
#include <vector>

#include "jobs/child.hpp"
#include "serve/request.hpp"

namespace shelfbeam::serve {

/// The answer to a request that was begun before.
struct LateReply {
  http::TabId tab;
  Json message;
};

/// A request whose answer is a short command of this program in a process of its own, which alone opens
/// signal files. One at a time.
class Errand {
 public:
  /// `program`: shelfbeam. `key`: of the answer. `what`: names it in errors.
  Errand(std::string program, const char* key, std::string what)
      : program_(std::move(program)), key_(key), what_(std::move(what)) {}

  /// `words`: the command, which prints JSON. `names`: members that the answer has besides. Throws InputError
  /// while another one is running.
  void start(const Request& request, std::vector<std::string> words, Json names = Json::object());
  /// To be called often. Returns the answer once it is known: the JSON, or an error if the command fails.
  std::optional<LateReply> poll();

 private:
  std::string program_;
  const char* key_;
  std::string what_;
  std::optional<jobs::Child> child_;
  http::TabId tab_ = 0;
  Json id_, names_;
};

}  // namespace shelfbeam::serve
