// Tests the program on a pseudo terminal.

#include <cstdlib>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include "app/text/width.hpp"
#include "system/app/program.hpp"

namespace shelfbeam {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr std::string_view clear_line = "\r\033[K";

class Terminal : public test::ProgramTest {
 protected:
  // Everything that the program writes to a terminal of this width.
  std::string shown(const std::string& line, int columns,
                    const std::map<std::string, std::string>& variables = {}) const {
    std::vector<std::string> command = test::command(test::words(folder, line));
    std::vector<char*> arguments(command.size() + 1, nullptr);
    for (std::size_t i = 0; i < command.size(); ++i) arguments[i] = command[i].data();
    winsize size{};
    size.ws_col = static_cast<unsigned short>(columns);
    int terminal = -1;
    const pid_t id = ::forkpty(&terminal, nullptr, nullptr, &size);
    if (id == 0) {
      ::setenv("TERM", "xterm", 1);
      ::unsetenv("NO_COLOR");
      for (const auto& [name, value] : variables) ::setenv(name.c_str(), value.c_str(), 1);
      ::execv(arguments[0], arguments.data());
      ::_exit(127);
    }
    std::string text;
    char part[4096];
    for (ssize_t got = 0; (got = ::read(terminal, part, sizeof part)) > 0;)
      text.append(part, static_cast<std::size_t>(got));
    ::close(terminal);
    int status = 0;
    ::waitpid(id, &status, 0);
    EXPECT_TRUE(WIFEXITED(status)) << text;
    return text;
  }

  // The progress lines in that text.
  static std::vector<std::string> drawn(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t at = text.find(clear_line); at != std::string::npos; at = text.find(clear_line, at)) {
      at += clear_line.size();
      lines.push_back(text.substr(at, text.find_first_of("\r\n", at) - at));
    }
    if (!lines.empty()) lines.pop_back();  // the result follows the last clearing
    return lines;
  }
};

TEST_F(Terminal, ProgressFitsNarrowWindows) {
  const std::string run = "simulate @store.json -o @signal.h5 --samples 4000";
  for (const int columns : {40, 100}) {
    const std::vector<std::string> lines = drawn(shown(run, columns));
    ASSERT_GE(lines.size(), 2u);
    for (const std::string& line : lines)
      EXPECT_LT(app::width_of(line), static_cast<std::size_t>(columns)) << line;
    EXPECT_THAT(lines, testing::Contains(testing::StartsWith("simulating")));
  }
  EXPECT_TRUE(drawn(shown(run, 40, {{"TERM", "dumb"}})).empty());
  EXPECT_TRUE(drawn(shown(run + " --quiet", 40)).empty());
}

TEST_F(Terminal, ColoursAreForTerminalsThatWantThem) {
  folder.write("matrix.csv", "label,T1,T2\nL1,1,2\nL2,3,0\n");
  const std::string place = "place @matrix.csv --threshold 2";
  EXPECT_THAT(shown(place, 80), HasSubstr("\033[1m2 transceivers reach"));
  EXPECT_THAT(shown("place @none.csv", 80), HasSubstr("\033[1;31merror:\033[0m "));
  EXPECT_THAT(shown("plan @store.json --sampels 3", 80), HasSubstr("\033[1;31merror:\033[0m unknown option"));
  for (const auto& [name, value] : std::map<std::string, std::string>{{"NO_COLOR", "1"}, {"TERM", "dumb"}})
    for (const std::string& line : {place, std::string("place @none.csv")})
      EXPECT_THAT(shown(line, 80, {{name, value}}), Not(HasSubstr("\033[1")));
  EXPECT_THAT(shown(place + " --json", 80), Not(HasSubstr("\033[1")));
  EXPECT_THAT(told(place), Not(HasSubstr("\033")));
}

}  // namespace
}  // namespace shelfbeam
