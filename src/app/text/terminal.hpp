#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/control.hpp"

namespace shelfbeam::app {

/// A progress line with the time remaining on standard error; silent when that is no terminal.
class TerminalProgress : public ProgressSink {
 public:
  explicit TerminalProgress(bool quiet);
  ~TerminalProgress() override;
  /// Itself, or nothing where nobody watches.
  ProgressSink* sink() { return active_ ? this : nullptr; }
  void report(std::string_view task, double fraction, std::string_view detail) override;

 private:
  using Clock = std::chrono::steady_clock;

  bool active_;
  bool drawn_ = false;
  double first_ = 0;  ///< the fraction that the task began with
  std::string task_;
  Clock::time_point started_, last_;
};

/// The summary that `--json` asks for. Paths need not be UTF-8; JSON must.
inline void print_json(const nlohmann::ordered_json& json) {
  fmt::print("{}\n", json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

/// Makes Ctrl-C, SIGTERM and a terminal that goes away ask the running work to end with what it has; a second
/// Ctrl-C ends the program.
const CancelToken& cancel_on_signal();

/// Prints rows with columns as wide as they need, the first `left` of them left-aligned, the others right.
/// The first row is the heading.
void print_table(const std::vector<std::vector<std::string>>& rows, std::size_t left);

}  // namespace shelfbeam::app
