#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "project_folder.hpp"
#include "serve/project/project.hpp"
#include "support/expect_input_error.hpp"
#include "unit/serve/text/edit_ops.hpp"

namespace shelfbeam::serve {
namespace {

namespace fs = std::filesystem;

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

// Undoes and redoes all, and changes something.
void expect_usable(Project& project, const ProjectFolder& folder) {
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

TEST(History, ARecordAheadOfTheFileIsRedone) {
  const Written written = two_edits();
  const ProjectFolder folder(written.before);
  folder.write_history(written.history);
  Project project(folder.path());
  EXPECT_EQ(folder.store(), written.store);
  EXPECT_EQ(project.position(), 2u);
  expect_usable(project, folder);
}

// Tests take most of their time to wait for the disk: the fast ones try few places.
void cut_last_record(std::size_t stride) {
  const Written written = two_edits();
  const std::size_t last = written.history.rfind('\n', written.history.size() - 2) + 1;
  for (std::size_t size = last; size < written.history.size(); size += stride) {
    // The process was killed while it wrote the record.
    const ProjectFolder folder(written.before);
    folder.write_history(written.history.substr(0, size));
    Project project(folder.path());
    ASSERT_EQ(project.position(), 1u) << size;
    ASSERT_EQ(project.text(), written.before) << size;
    ASSERT_EQ(read_file(folder.history()), written.history.substr(0, last)) << size;
    if ((size - last) % 16 == 0) expect_usable(project, folder);
    ASSERT_FALSE(fs::exists(folder / ".shelfbeam/history.jsonl.damaged"));
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
    const ProjectFolder folder(written.store);
    folder.write_history(written.history.substr(0, size));
    Project project(folder.path());
    ASSERT_EQ(folder.store(), written.store);
    ASSERT_EQ(project.steps().back().label, "Changed outside");
    expect_usable(project, folder);
  }
}

void change_bytes(std::size_t stride) {
  const Written written = two_edits();
  const std::size_t first = written.history.find('\n') + 1;
  const std::size_t last = written.history.rfind('\n', written.history.size() - 2) + 1;
  for (std::size_t at = 0; at < written.history.size(); at += stride) {
    std::string damaged = written.history;
    damaged[at] ^= 1;
    const ProjectFolder folder(written.store);
    folder.write_history(damaged);
    Project project(folder.path());
    ASSERT_EQ(folder.store(), written.store) << at;
    const std::string kept = (folder / ".shelfbeam/history.jsonl.damaged").string();
    // Labels and times have no hash: their bytes may change.
    if (project.steps().empty() || project.steps().back().label != "Changed outside") continue;
    if (at < last) {
      EXPECT_EQ(read_file(kept), damaged) << at;
    }
    if (at > first) expect_usable(project, folder);
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
  test::expect_input_error([&] { Project project(folder.path()); }, "history.jsonl: line 1",
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

}  // namespace
}  // namespace shelfbeam::serve
