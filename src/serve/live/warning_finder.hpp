#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "jobs/child.hpp"

namespace shelfbeam::serve {

/// Looks for implausible values in a store file, which takes long in a large shop, in a process of its own.
/// It begins when the file has not changed for a while.
class WarningFinder {
 public:
  using Clock = std::chrono::steady_clock;

  /// `program`: shelfbeam.
  explicit WarningFinder(std::filesystem::path file, std::string program = jobs::own_program);

  /// The file has changed: its warnings are no longer known.
  void restart(Clock::time_point now);
  /// To be called often. Returns the findings of `inspect --json` once they are known; an empty list if the
  /// store has problems, and one finding that says so if the search fails.
  std::optional<nlohmann::ordered_json> poll(Clock::time_point now);

 private:
  static constexpr auto quiet = std::chrono::milliseconds(300);

  std::filesystem::path file_;
  std::string program_;
  std::optional<Clock::time_point> begin_;
  std::optional<jobs::Child> child_;
};

}  // namespace shelfbeam::serve
