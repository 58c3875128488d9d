#include "app/text/terminal.hpp"

#include <algorithm>
#include <csignal>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace shelfbeam::app {

TerminalProgress::TerminalProgress(bool quiet) : active_(!quiet && ::isatty(STDERR_FILENO) == 1) {}

TerminalProgress::~TerminalProgress() {
  clear();
}

void TerminalProgress::clear() {
  if (drawn_) fmt::print(stderr, "\r\033[K");
  drawn_ = false;
}

void TerminalProgress::report(std::string_view task, double fraction, std::string_view detail) {
  if (!active_) return;
  const Clock::time_point now = Clock::now();
  if (task != task_) {
    task_ = task;
    started_ = now;
    first_ = std::max(0.0, fraction);
  } else if (now - last_ < std::chrono::milliseconds(100)) {
    return;
  }
  last_ = now;
  drawn_ = true;
  const double elapsed = std::chrono::duration<double>(now - started_).count();
  if (fraction < 0) {
    fmt::print(stderr, "\r\033[K{} {:.0f} s  {}", task, elapsed, detail);
  } else {
    constexpr int width = 30;
    const int filled = static_cast<int>(fraction * width);
    const std::string left =
        fraction - first_ > 0.01
            ? fmt::format("{:.0f} s left", elapsed * (1 - fraction) / (fraction - first_))
            : "";
    fmt::print(stderr, "\r\033[K{} [{:#<{}}{:.<{}}] {:3.0f} %  {}  {}", task, "", filled, "", width - filled,
               fraction * 100, left, detail);
  }
  std::fflush(stderr);
}

namespace {

CancelToken signal_token;

void on_signal(int number) {
  signal_token.request();
  std::signal(number, SIG_DFL);
}

}  // namespace

const CancelToken& cancel_on_signal() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  if (std::signal(SIGHUP, on_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup
  return signal_token;
}

}  // namespace shelfbeam::app
