#include "app/text/style.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

#include <fmt/format.h>
#include <unistd.h>

namespace shelfbeam::app {

namespace {

// Empty if the variable is not set.
std::string_view variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

}  // namespace

bool is_terminal(std::FILE* stream) {
  const std::string_view terminal = variable("TERM");
  return !terminal.empty() && terminal != "dumb" && ::isatty(::fileno(stream)) == 1;
}

std::string styled(Style style, std::string_view text, std::FILE* stream) {
  if (!variable("NO_COLOR").empty() || !is_terminal(stream)) return std::string(text);
  constexpr const char* codes[] = {"1", "33", "1;31"};
  return fmt::format("\033[{}m{}\033[0m", codes[static_cast<std::size_t>(style)], text);
}

std::string with_answer(std::string_view text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  return styled(Style::answer, text.substr(0, end)).append(text.substr(end));
}

}  // namespace shelfbeam::app
