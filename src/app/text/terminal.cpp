#include "app/text/terminal.hpp"

#include <algorithm>
#include <csignal>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace shelfbeam::app {

namespace {

CancelToken signal_token;

void on_signal(int number) {
  signal_token.request();
  std::signal(number, SIG_DFL);
}

// The number of UTF-8 characters, not of bytes.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80; }));
}

}  // namespace

TerminalProgress::TerminalProgress(bool quiet) : active_(!quiet && ::isatty(STDERR_FILENO) == 1) {}

TerminalProgress::~TerminalProgress() {
  if (drawn_) fmt::print(stderr, "\r\033[K");
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

const CancelToken& cancel_on_signal() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  if (std::signal(SIGHUP, on_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup
  return signal_token;
}

void print_table(const std::vector<std::vector<std::string>>& rows, std::size_t left) {
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
