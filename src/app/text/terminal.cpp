#include "app/text/terminal.hpp"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/expect_running.hpp"

#include "app/text/end_at_once.hpp"
#include "app/text/style.hpp"
#include "app/text/width.hpp"

namespace shelfbeam::app {

namespace {

CancelToken signal_token;
std::atomic<int> code_to_end_at_once{0};  // 0: the work ends with its results so far

// `timeout` signals the process and then its group, so a second signal counts only after a second.
void on_signal(int number) {
  if (const int code = code_to_end_at_once.load(std::memory_order_relaxed); code != 0) {
    for (const std::string_view part : {"stopped: ", stopped_without_result, "\n"}) [[maybe_unused]]
      const ssize_t written = ::write(STDERR_FILENO, part.data(), part.size());
    ::_exit(code);
  }
  static timespec first = {};
  timespec now = {};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  if (!signal_token.requested()) {
    first = now;
    signal_token.request();
  } else if (now.tv_sec > first.tv_sec + 1 || (now.tv_sec > first.tv_sec && now.tv_nsec >= first.tv_nsec)) {
    std::signal(number, SIG_DFL);
    std::raise(number);
  }
}

// The columns of the terminal, which change when its window does.
std::size_t terminal_width() {
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  const char* columns = std::getenv("COLUMNS");
  const double given = columns == nullptr ? 0 : to_number(columns).value_or(0);
  return given >= 1 && given <= 1000 ? static_cast<std::size_t>(given) : 80;
}

}  // namespace

// A reader of the messages that has ended must not end the run.
void write_error(std::string_view text) noexcept {
  sigset_t pipe, before;
  sigemptyset(&pipe);
  sigaddset(&pipe, SIGPIPE);
  ::pthread_sigmask(SIG_BLOCK, &pipe, &before);
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
  constexpr timespec none = {};
  ::sigtimedwait(&pipe, nullptr, &none);
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

TerminalProgress::TerminalProgress(bool quiet) : active_(!quiet && is_terminal(stderr)) {}

TerminalProgress::~TerminalProgress() {
  if (drawn_task_) print_message("\r\033[K");
}

void TerminalProgress::report(Task task, double fraction, std::string_view detail) {
  if (!active_) return;
  const Clock::time_point now = Clock::now();
  const jobs::Progress progress =
      stages_.update(task, fraction, detail, std::chrono::duration<double>(now - started_).count());
  if (progress.task == drawn_task_ && now - drawn_at_ < std::chrono::milliseconds(100)) return;
  drawn_at_ = now;
  drawn_task_ = progress.task;
  // Some terminals wrap a line that fills them.
  print_message("\r\033[K{}", progress_line(progress, terminal_width() - 1));
}

const CancelToken& cancel_on_signal() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  if (std::signal(SIGHUP, on_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup
  return signal_token;
}

EndAtOnce::EndAtOnce(int exit_code) {
  expect_running(&signal_token);
  code_to_end_at_once = exit_code;
}

EndAtOnce::~EndAtOnce() {
  code_to_end_at_once = 0;
}

std::string one_line(std::string_view message) {
  constexpr std::size_t most = 1000;
  return printable(shortened(message, most));
}

void print_table(std::vector<std::vector<std::string>> rows, std::size_t left) {
  for (auto& row : rows)
    for (std::string& cell : row) cell = one_line(cell);
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], width_of(row[k]));
  }
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t k = 0; k < row.size(); ++k) {
      const std::string padding(widths[k] - width_of(row[k]), ' ');
      line += "  " + (k < left ? row[k] + padding : padding + row[k]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    fmt::print("{}\n", line);
  }
}

}  // namespace shelfbeam::app
