#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "jobs/child.hpp"

namespace shelfbeam::serve {

/// A short command of this program in a process of its own, which alone opens signal files.
class Errand {
 public:
  /// `program`: shelfbeam. `what`: names it in errors.
  Errand(std::string program, std::string what) : program_(std::move(program)), what_(std::move(what)) {}

  bool is_running() const { return child_.has_value(); }
  /// `words`: the command, which prints JSON. Throws InputError while another one is running.
  void start(std::vector<std::string> words);
  /// To be called often. Returns the JSON once it is known; or an object with `message`, if the command
  /// fails.
  std::optional<nlohmann::ordered_json> poll();

 private:
  std::string program_, what_;
  std::optional<jobs::Child> child_;
};

}  // namespace shelfbeam::serve
