// Kills a process that edits a project, at random moments.

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <random>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "shelfbeam/base/json_parser.hpp"

#include "project_folder.hpp"
#include "serve/project/project.hpp"
#include "unit/serve/text/edit_ops.hpp"

namespace shelfbeam::serve {
namespace {

constexpr std::string_view counter_text = "{\n  // edits\n  \"n\": 0\n}\n";

int count_in(const std::string& text) {
  return parse_json(text, "store.json").at("n").get<int>();
}

void count_up(Project& project) {
  const int n = count_in(project.text());
  project.edit("Count", {to_set("/n", n, n + 1)});
}

// Counts up, undoes and redoes without end. The messages are the counts that are on the disk, and 0 before a
// count is undone.
[[noreturn]] void count_forever(const ProjectFolder& folder, const ProjectOptions& options, int messages) {
  const auto say = [&](std::int32_t message) {
    if (::write(messages, &message, sizeof message) != sizeof message) ::_exit(1);
  };
  try {
    Project project(folder.path(), options);
    for (;;) {
      count_up(project);
      say(count_in(project.text()));
      if (count_in(project.text()) % 3 != 0) continue;
      say(0);
      project.undo();
      project.redo();
      say(count_in(project.text()));
    }
  } catch (...) {
    ::_exit(2);
  }
}

struct Heard {
  std::int32_t count = 0;  ///< the last
  bool may_be_undone = false;
};

// Runs the counting process for a while, and kills it.
Heard kill_after(const ProjectFolder& folder, const ProjectOptions& options, std::chrono::milliseconds time) {
  int ends[2];
  EXPECT_EQ(::pipe(ends), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    count_forever(folder, options, ends[1]);
  }
  ::close(ends[1]);
  std::this_thread::sleep_for(time);
  ::kill(child, SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status)) << "the process ended by itself: " << WEXITSTATUS(status);
  Heard heard;
  for (std::int32_t message = 0; ::read(ends[0], &message, sizeof message) == sizeof message;) {
    heard.may_be_undone = message == 0;
    if (message > 0) heard.count = message;
  }
  ::close(ends[0]);
  return heard;
}

void expect_nothing_lost(int kills, unsigned seed, std::size_t steps = 1'000'000) {
  const ProjectOptions options{.history = {.steps = steps}};
  const ProjectFolder folder(counter_text);
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> milliseconds(0, 100);
  int own = 0, in_between = 0;
  for (int k = 0; k < kills; ++k) {
    const Heard heard = kill_after(folder, options, std::chrono::milliseconds(milliseconds(random)));
    const int acknowledged = std::max(own, heard.count);
    const int found = count_in(folder.store());
    Project project(folder.path(), options);
    const int count = count_in(project.text());
    if (found != count) ++in_between;
    ASSERT_EQ(project.text(), folder.store());
    ASSERT_FALSE(project.locked());
    ASSERT_GE(count, acknowledged - (heard.may_be_undone ? 1 : 0)) << "after kill " << k;
    ASSERT_LE(count, acknowledged + 1);
    for (const Step& step : project.steps()) ASSERT_EQ(step.label, "Count");
    const auto edits = static_cast<std::size_t>(count);
    if (edits <= steps)
      ASSERT_EQ(project.position(), edits) << "a step for each edit, and no others";
    else
      ASSERT_LE(project.steps().size(), 2 * steps);
    if (count < acknowledged) project.redo();
    count_up(project);
    project.undo();
    project.redo();
    own = count_in(folder.store());
    ASSERT_EQ(own, std::max(count, acknowledged) + 1);
  }
  testing::Test::RecordProperty("finished_after_the_kill", in_between);
  Project project(folder.path(), options);
  project.go(0);
  if (static_cast<std::size_t>(own) <= steps) {
    EXPECT_EQ(folder.store(), counter_text);
  }
}

TEST(KilledProcess, LosesNoAcknowledgedEdit) {
  expect_nothing_lost(20, 1);
}

TEST(LongKilledProcess, LosesNoAcknowledgedEdit) {
  expect_nothing_lost(100, 2);
}

TEST(LongKilledProcess, LosesNothingWhileItShortensTheHistory) {
  expect_nothing_lost(100, 3, 5);
}

}  // namespace
}  // namespace shelfbeam::serve
