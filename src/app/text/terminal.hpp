#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/control.hpp"

#include "app/text/progress_line.hpp"

namespace shelfbeam::app {

/// Draws progress as one line on standard error; silent if that is not a terminal.
class TerminalProgress : public ProgressSink {
 public:
  explicit TerminalProgress(bool quiet);
  ~TerminalProgress() override;
  /// This object, or null if nothing is drawn.
  ProgressSink* sink() { return active_ ? this : nullptr; }
  void report(Task task, double fraction, std::string_view detail) override;

 private:
  using Clock = std::chrono::steady_clock;

  bool active_;
  jobs::ProgressStages stages_;
  std::optional<Task> drawn_task_;
  Clock::time_point started_ = Clock::now(), drawn_at_;
};

/// Writes to standard error. If that is closed or full, the text is lost, and nothing else happens.
void write_error(std::string_view text) noexcept;

/// Formats a message for standard error.
template <class... T>
void print_message(fmt::format_string<T...> format, T&&... values) {
  write_error(fmt::format(format, std::forward<T>(values)...));
}

/// Prints the summary for `--json`. Bytes of paths that are not UTF-8 are replaced, as JSON requires.
inline void print_json(const nlohmann::ordered_json& json) {
  fmt::print("{}\n", json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

/// A message of at most about 1000 characters without control characters.
std::string one_line(std::string_view message);

/// After Ctrl-C, SIGTERM or the loss of the terminal, the running work ends with the results so far. A second
/// Ctrl-C, at least a second later, ends the program.
const CancelToken& cancel_on_signal();

/// Prints rows in aligned columns: the first `left` columns left-aligned, the others right-aligned. The first
/// row is the heading.
void print_table(std::vector<std::vector<std::string>> rows, std::size_t left);

}  // namespace shelfbeam::app
