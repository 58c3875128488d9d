#include "serve/project/project.hpp"

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "project_folder.hpp"
#include "support/expect_input_error.hpp"
#include "unit/serve/text/edit_ops.hpp"

namespace shelfbeam::serve {
namespace {

using std::chrono::milliseconds;
using test::expect_input_error;
using testing::ElementsAre;
using testing::IsEmpty;

std::string edited_text(int a) {
  return fmt::format("{{ // shop\n  \"a\": {},\n  \"b\": [1, 2.0] // list\n}}\n", a);
}

std::vector<std::string> labels(const Project& project) {
  std::vector<std::string> labels;
  for (const Step& step : project.steps())
    labels.push_back((labels.size() < project.position() ? "+" : "-") + step.label);
  return labels;
}

class ProjectTest : public testing::Test {
 protected:
  Project open() {
    return Project(folder.path(), {.now = [this] { return now; }});
  }
  ProjectFolder folder;
  std::chrono::system_clock::time_point now{std::chrono::seconds(1'764'246'632) + milliseconds(123)};
};

TEST_F(ProjectTest, EditsAreOnTheDisk) {
  auto project = open();
  EXPECT_EQ(project.text(), ProjectFolder::first_text);
  EXPECT_EQ(project.revision(), 1u);
  project.edit("Change a", {to_set("/a", 1, 2)});
  EXPECT_EQ(project.text(), edited_text(2));
  EXPECT_EQ(folder.store(), project.text());
  EXPECT_EQ(project.revision(), 2u);
  EXPECT_EQ(project.position(), 1u);
  ASSERT_EQ(project.steps().size(), 1u);
  EXPECT_EQ(project.steps()[0].label, "Change a");
  EXPECT_EQ(project.steps()[0].time, "2025-11-27T12:30:32.123Z");
  EXPECT_THAT(folder.lines()[1],
              testing::StartsWith(R"({"time":"2025-11-27T12:30:32.123Z","label":"Change a",)"));
}

TEST_F(ProjectTest, UndoAndRedoSurviveARestart) {
  {
    auto project = open();
    for (int a = 2; a <= 4; ++a) project.edit(fmt::format("a{}", a), {to_set("/a", a - 1, a)});
    project.undo();
    EXPECT_EQ(folder.store(), edited_text(3));
  }
  {
    auto project = open();
    EXPECT_THAT(labels(project), ElementsAre("+a2", "+a3", "-a4"));
    project.undo();
    project.undo();
    project.undo();
    EXPECT_EQ(folder.store(), ProjectFolder::first_text);
    EXPECT_EQ(project.position(), 0u);
  }
  auto project = open();
  EXPECT_THAT(labels(project), ElementsAre("-a2", "-a3", "-a4"));
  project.redo();
  EXPECT_EQ(folder.store(), edited_text(2));
  project.go(3);
  project.redo();
  EXPECT_EQ(folder.store(), edited_text(4));
  project.go(1);
  EXPECT_EQ(folder.store(), edited_text(2));
  expect_input_error([&] { project.go(4); }, "the history: has 3 steps");
}

TEST_F(ProjectTest, AnEditDropsWhatIsUndone) {
  {
    auto project = open();
    for (int a = 2; a <= 4; ++a) project.edit(fmt::format("a{}", a), {to_set("/a", a - 1, a)});
    project.go(1);
    project.edit("a9", {to_set("/a", 2, 9)});
    EXPECT_THAT(labels(project), ElementsAre("+a2", "+a9"));
  }
  auto project = open();
  EXPECT_THAT(labels(project), ElementsAre("+a2", "+a9"));
  project.go(0);
  EXPECT_EQ(folder.store(), ProjectFolder::first_text);
}

TEST_F(ProjectTest, QuickEditsOfTheSamePathsAreOneStep) {
  const auto nudge = [&](Project& project, int from, const std::string& label = "Nudge") {
    project.edit(label, {to_set("/a", from, from + 1)}, true);
  };
  {
    auto project = open();
    nudge(project, 1);
    now += milliseconds(800);
    nudge(project, 2);
    now += milliseconds(700);
    nudge(project, 3);
    EXPECT_THAT(labels(project), ElementsAre("+Nudge"));
    now += milliseconds(801);
    nudge(project, 4);
    EXPECT_THAT(labels(project), ElementsAre("+Nudge", "+Nudge")) << "too late";
    nudge(project, 5, "Type");
    nudge(project, 6);
    EXPECT_EQ(project.steps().size(), 4u) << "other labels";
    project.edit("Nudge", {to_set("/b/0", 1, 2)}, true);
    EXPECT_EQ(project.steps().size(), 5u) << "another path";
    project.edit("Nudge", {to_set("/b/0", 2, 3)});
    EXPECT_EQ(project.steps().size(), 6u) << "without `join`";
    project.edit("Nudge", {to_set("/b/0", 3, 5)}, true);
    EXPECT_EQ(project.steps().size(), 7u) << "after an edit without `join`";
    project.undo();
    project.undo();
    project.edit("Nudge", {to_set("/b/0", 2, 4)}, true);
    EXPECT_EQ(project.steps().size(), 6u) << "after undo";
  }
  auto project = open();
  project.edit("Nudge", {to_set("/b/0", 4, 5)}, true);
  EXPECT_EQ(project.steps().size(), 7u) << "after a restart";
  project.go(1);
  EXPECT_EQ(folder.store(), edited_text(4));
  project.undo();
  EXPECT_EQ(folder.store(), ProjectFolder::first_text);
}

TEST_F(ProjectTest, AnEqualValueIsNoStep) {
  auto project = open();
  project.edit("Nothing", {to_set("/b/1", 2, 2.0)});
  EXPECT_THAT(project.steps(), IsEmpty());
  EXPECT_EQ(project.revision(), 1u);
  EXPECT_EQ(folder.lines().size(), 1u);
  project.undo();
  project.redo();
  EXPECT_EQ(project.revision(), 1u);
}

TEST_F(ProjectTest, RefusedEditsChangeNothing) {
  auto project = open();
  EXPECT_THROW(project.edit("Change a", {to_set("/a", 7, 2)}), EditConflict);
  expect_input_error(
      [&] { project.edit("All", {to_set("", Json::parse(folder.store(), nullptr, true, true), 1)}); },
      "store.json: is not a JSON object");
  expect_input_error([&] { project.edit("Large", {to_set("/a", 1, std::string(max_store_text, 'x'))}); },
                     "store.json: has 5,000,0", "the maximum is 5,000,000");
  EXPECT_EQ(folder.store(), ProjectFolder::first_text);
  EXPECT_EQ(folder.lines().size(), 1u);
  EXPECT_EQ(project.revision(), 1u);
}

TEST_F(ProjectTest, BytesThatAreNotUtf8AreKept) {
  const std::string text = "{ \"a\": \"\xC3\xA4\", // K\xFChl\n}";
  folder.write_store(text);
  {
    auto project = open();
    project.edit("Change a", {to_set("/a", "\xC3\xA4", "\xC3\xB6")});
    folder.write_store("{ \"a\": 1 } // K\xFChl");
    EXPECT_TRUE(project.check_outside());
  }
  auto project = open();
  EXPECT_EQ(project.steps().size(), 2u);
  project.go(0);
  EXPECT_EQ(folder.store(), text);
}

TEST_F(ProjectTest, ASecondProcessIsRefused) {
  const auto project = open();
  expect_input_error([&] { open(); }, folder.path().string() + ": is in use by another run of shelfbeam",
                     fmt::format("(process {})", ::getpid()), "use the page of the other, or end it");
}

TEST_F(ProjectTest, AFolderWithoutAStoreStaysAsItIs) {
  std::filesystem::remove(folder / "store.json");
  expect_input_error([&] { open(); }, "store.json: does not exist");
  folder.write_store("[1");
  expect_input_error([&] { open(); }, "store.json: is not valid JSON", "line 1, column 3");
  folder.write_store("[1]");
  expect_input_error([&] { open(); }, "store.json: is not a JSON object");
  EXPECT_FALSE(std::filesystem::exists(folder / ".shelfbeam"));
}

TEST_F(ProjectTest, TheCallerChecksEachText) {
  const auto refuse_format_2 = [](const Json& store) {
    if (store.value("format", 1) > 1) throw InputError("store.json", "has format version 2");
  };
  const ProjectOptions options{.check = refuse_format_2};
  Project project(folder.path(), options);
  expect_input_error([&] { project.edit("Format", {to_insert("/format", 2)}); }, "has format version 2");
  folder.write_store("{ \"format\": 2 }");
  EXPECT_TRUE(project.check_outside());
  EXPECT_EQ(project.locked(), "store.json: has format version 2");
}

TEST_F(ProjectTest, ChecksTheTextsOfAHistoryFromElsewhere) {
  {
    auto project = open();
    project.edit("Format", {to_insert("/format", 2)});
    project.edit("Format", {to_set("/format", 2, 3)});
  }
  const auto refusing = [](int format) {
    return ProjectOptions{.check = [=](const Json& store) {
      if (store.value("format", 1) == format) throw InputError("store.json", "has the wrong format");
    }};
  };
  expect_input_error([&] { Project project(folder.path(), refusing(3)); }, "has the wrong format");
  Project project(folder.path(), refusing(2));
  expect_input_error([&] { project.undo(); }, "has the wrong format");
  project.go(0);
  EXPECT_EQ(folder.store(), ProjectFolder::first_text);
}

TEST_F(ProjectTest, ARemovedHistoryIsWrittenAnew) {
  {
    auto project = open();
    project.edit("a2", {to_set("/a", 1, 2)});
    project.edit("a3", {to_set("/a", 2, 3)});
    project.undo();
    std::filesystem::remove_all(folder / ".shelfbeam");
    project.redo();
    project.undo();
    expect_input_error([&] { open(); }, "is in use by another run of shelfbeam");
  }
  auto project = open();
  EXPECT_THAT(labels(project), ElementsAre("+a2", "-a3"));
}

TEST_F(ProjectTest, ARemovedHistoryThatAnotherProcessHasWrittenIsLeftAlone) {
  auto project = std::make_unique<Project>(folder.path());
  std::filesystem::remove_all(folder / ".shelfbeam");
  auto other = open();
  expect_input_error([&] { project->edit("a2", {to_set("/a", 1, 2)}); }, "is in use by another run");
  folder.write_store(edited_text(3));
  EXPECT_TRUE(project->check_outside());
  EXPECT_TRUE(project->locked());
  project.reset();
  expect_input_error([&] { open(); }, "is in use by another run");
  EXPECT_TRUE(other.check_outside());
  EXPECT_EQ(other.steps().size(), 1u);
}

TEST_F(ProjectTest, PermissionsAreKept) {
  namespace fs = std::filesystem;
  fs::permissions(folder / "store.json", fs::perms::owner_read | fs::perms::owner_write);
  auto project = open();
  project.edit("Change a", {to_set("/a", 1, 2)});
  EXPECT_EQ(fs::status(folder / "store.json").permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(fs::status(folder / ".shelfbeam").permissions(), fs::perms::owner_all);
}

}  // namespace
}  // namespace shelfbeam::serve
