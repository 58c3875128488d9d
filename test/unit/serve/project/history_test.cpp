// Tests histories that are short, damaged or old, and those of a process that is killed at random moments.
// The test of the server undoes and redoes before it is killed, too.

#include <csignal>

#include <sys/wait.h>
#include <unistd.h>

#include "unit/serve/project/project_folder.hpp"

namespace shelfbeam::serve {
namespace {

struct Written {
  std::string history, before, store;  ///< `before`: the store before the last record
};

Written two_edits() {
  const ProjectFolder folder;
  Project project(folder.path());
  project.edit("First", {to_set("/a", 1, 2)});
  Written written{{}, folder.store(), {}};
  project.edit("Second", {to_set("/a", 2, 3), to_insert("/c", "x")});
  written.history = read_file(folder.history());
  written.store = folder.store();
  return written;
}

// A project with a store and a history that may not fit.
struct Recovered {
  Recovered(std::string_view store, std::string_view history) : folder(store), project(opened(history)) {}

  // Undoes and redoes all, and changes something.
  void expect_usable() {
    const std::string text = project.text();
    const std::size_t steps = project.position();
    project.go(0);
    EXPECT_EQ(folder.store(), ProjectFolder::first_text);
    project.go(steps);
    EXPECT_EQ(folder.store(), text);
    project.edit("Next", {to_insert("/next", 1)});
    project.undo();
    EXPECT_EQ(folder.store(), text);
  }

  ProjectFolder folder;
  Project project;

 private:
  Project opened(std::string_view history) const {
    folder.write_history(history);
    return Project(folder.path());
  }
};

TEST(History, ARecordAheadOfTheFileIsRedone) {
  const Written written = two_edits();
  Recovered found(written.before, written.history);
  EXPECT_EQ(found.folder.store(), written.store);
  EXPECT_EQ(found.project.position(), 2u);
  found.expect_usable();
}

// Tests take most of their time to wait for the disk: the fast ones try few places.
void cut_last_record(std::size_t stride) {
  const Written written = two_edits();
  const std::size_t last = written.history.rfind('\n', written.history.size() - 2) + 1;
  for (std::size_t size = last; size < written.history.size(); size += stride) {
    // The process was killed while it wrote the record.
    Recovered found(written.before, written.history.substr(0, size));
    ASSERT_EQ(found.project.position(), 1u) << size;
    ASSERT_EQ(found.project.text(), written.before) << size;
    ASSERT_EQ(read_file(found.folder.history()), written.history.substr(0, last)) << size;
    if ((size - last) % 16 == 0) found.expect_usable();
    ASSERT_FALSE(fs::exists(found.folder / ".shelfbeam/history.jsonl.damaged"));
  }
}

TEST(History, ATruncatedRecordIsCutOff) {
  cut_last_record(16);
}

TEST(SlowHistory, ARecordTruncatedAnywhereIsCutOff) {
  cut_last_record(1);
}

TEST(History, TheFileWinsOverALostRecord) {
  const Written written = two_edits();
  const std::size_t last = written.history.rfind('\n', written.history.size() - 2) + 1;
  for (std::size_t size = last; size < written.history.size(); size += 101) {
    Recovered found(written.store, written.history.substr(0, size));
    ASSERT_EQ(found.folder.store(), written.store);
    ASSERT_EQ(found.project.steps().back().label, "Changed outside");
    found.expect_usable();
  }
}

void change_bytes(std::size_t stride) {
  const Written written = two_edits();
  const std::size_t first = written.history.find('\n') + 1;
  const std::size_t last = written.history.rfind('\n', written.history.size() - 2) + 1;
  for (std::size_t at = 0; at < written.history.size(); at += stride) {
    std::string damaged = written.history;
    damaged[at] ^= 1;
    Recovered found(written.store, damaged);
    ASSERT_EQ(found.folder.store(), written.store) << at;
    // Labels and times have no hash: their bytes may change.
    const std::vector<Step> steps = found.project.steps();
    if (steps.empty() || steps.back().label != "Changed outside") continue;
    if (at < last) {
      EXPECT_EQ(read_file(found.folder / ".shelfbeam/history.jsonl.damaged"), damaged) << at;
    }
    if (at > first) found.expect_usable();
  }
}

TEST(History, AChangedByteIsNoticed) {
  change_bytes(101);
}

TEST(SlowHistory, AnyChangedByteIsNoticed) {
  change_bytes(3);
}

TEST(History, WithoutItsBeginningStartsAnew) {
  const Written written = two_edits();
  const ProjectFolder folder(written.store);
  folder.write_history("x" + written.history);
  {
    Project project(folder.path());
    EXPECT_TRUE(project.steps().empty());
    project.edit("Next", {to_set("/a", 3, 4)});
  }
  EXPECT_EQ(read_file(folder / ".shelfbeam/history.jsonl.damaged"), "x" + written.history);
  folder.write_history("");
  EXPECT_TRUE(Project(folder.path()).steps().empty());
}

TEST(History, OfANewerFormatIsLeftAlone) {
  Written written = two_edits();
  written.history.replace(written.history.find("\"format\":1"), 10, "\"format\":2");
  const ProjectFolder folder(written.store);
  folder.write_history(written.history);
  expect_input_error([&] { Project project(folder.path()); }, "history.jsonl: line 1",
                     "format version 2, but this program reads 1");
  EXPECT_EQ(read_file(folder.history()), written.history);
}

TEST(History, IsShortenedToItsNewestSteps) {
  const ProjectOptions options{.history = {.steps = 5}};
  const ProjectFolder folder;
  {
    Project project(folder.path(), options);
    for (int a = 1; a <= 10; ++a) project.edit(fmt::format("{}", a), {to_set("/a", a, a + 1)});
    EXPECT_EQ(project.steps().size(), 10u);
    EXPECT_EQ(folder.lines().size(), 11u);
    project.edit("11", {to_set("/a", 11, 12)});
    EXPECT_EQ(project.steps().size(), 5u);
    EXPECT_EQ(folder.lines().size(), 6u);
    project.go(2);
  }
  {
    Project project(folder.path(), options);
    EXPECT_EQ(project.steps().size(), 5u);
    EXPECT_EQ(project.steps().front().label, "7");
    EXPECT_EQ(project.position(), 2u);
  }
  Project project(folder.path(), {.history = {.steps = 1}});
  EXPECT_EQ(project.steps().size(), 3u) << "undone steps are kept";
  EXPECT_EQ(project.position(), 0u);
  project.go(3);
  EXPECT_EQ(folder.store(), "{ // shop\n  \"a\": 12,\n  \"b\": [1, 2.0] // list\n}\n");
}

TEST(History, IsShortenedWhenItsTextsAreLarge) {
  const ProjectOptions options{.history = {.bytes = 20'000}};
  const ProjectFolder folder;
  Project project(folder.path(), options);
  std::string text = "x";
  for (int k = 0; k < 40; ++k) {
    const std::string next(1000, static_cast<char>('a' + k % 26));
    project.edit("Text", {k == 0 ? to_insert("/t", next) : to_set("/t", text, next)});
    text = next;
    EXPECT_LE(fs::file_size(folder.history()), 25'000u);
  }
  EXPECT_GE(project.steps().size(), 4u);
  project.go(0);
  project.go(project.steps().size());
  EXPECT_NE(folder.store().find(text), std::string::npos);
}

constexpr std::string_view counter_text = "{\n  // edits\n  \"n\": 0\n}\n";

int count_in(const std::string& text) {
  return parse_json(text, "store.json").at("n").get<int>();
}

void count_up(Project& project) {
  const int n = count_in(project.text());
  project.edit("Count", {to_set("/n", n, n + 1)});
}

// Counts up without end, and writes each count that is on the disk into a pipe.
[[noreturn]] void count_forever(const ProjectFolder& folder, const ProjectOptions& options, int counts) {
  try {
    Project project(folder.path(), options);
    for (;;) {
      count_up(project);
      const int count = count_in(project.text());
      if (::write(counts, &count, sizeof count) != sizeof count) ::_exit(1);
    }
  } catch (...) {
    ::_exit(2);
  }
}

// Runs the counting process for a while, and kills it. The last count that it wrote, or 0.
int kill_after(const ProjectFolder& folder, const ProjectOptions& options, milliseconds time) {
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
  int status = 0, last = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status)) << "the process ended by itself: " << WEXITSTATUS(status);
  for (int count = 0; ::read(ends[0], &count, sizeof count) == sizeof count;) last = count;
  ::close(ends[0]);
  return last;
}

void expect_nothing_lost(int kills, unsigned seed, std::size_t steps = 1'000'000) {
  const ProjectOptions options{.history = {.steps = steps}};
  const ProjectFolder folder(counter_text);
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> moment(0, 100);
  int own = 0, in_between = 0;
  for (int k = 0; k < kills; ++k) {
    const int acknowledged = std::max(own, kill_after(folder, options, milliseconds(moment(random))));
    const int found = count_in(folder.store());
    Project project(folder.path(), options);
    const int count = count_in(project.text());
    if (found != count) ++in_between;
    ASSERT_EQ(project.text(), folder.store());
    ASSERT_FALSE(project.locked());
    ASSERT_GE(count, acknowledged) << "after kill " << k;
    ASSERT_LE(count, acknowledged + 1);
    for (const Step& step : project.steps()) ASSERT_EQ(step.label, "Count");
    const auto edits = static_cast<std::size_t>(count);
    if (edits <= steps)
      ASSERT_EQ(project.position(), edits) << "a step for each edit, and no others";
    else
      ASSERT_LE(project.steps().size(), 2 * steps);
    count_up(project);
    project.undo();
    project.redo();
    own = count_in(folder.store());
    ASSERT_EQ(own, count + 1);
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
