#include "serve/project/project.hpp"

#include "unit/serve/project/project_folder.hpp"

namespace shelfbeam::serve {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::string edited_text(int a) {
  return fmt::format("{{ // shop\n  \"a\": {},\n  \"b\": [1, 2.0] // list\n}}\n", a);
}

class ProjectTest : public OpenProject {};

TEST_F(ProjectTest, EditsAreOnTheDisk) {
  EXPECT_EQ(project().text(), ProjectFolder::first_text);
  EXPECT_EQ(project().revision(), 1u);
  set_a(1, 2);
  EXPECT_EQ(project().text(), edited_text(2));
  EXPECT_EQ(folder.store(), project().text());
  EXPECT_EQ(project().revision(), 2u);
  EXPECT_EQ(project().position(), 1u);
  ASSERT_EQ(project().steps().size(), 1u);
  EXPECT_EQ(project().steps()[0].label, "Change a");
  EXPECT_EQ(project().steps()[0].time, "2025-11-27T12:30:32.123Z");
  EXPECT_THAT(folder.lines()[1],
              testing::StartsWith(R"({"time":"2025-11-27T12:30:32.123Z","label":"Change a",)"));
}

TEST_F(ProjectTest, UndoAndRedoSurviveARestart) {
  for (int a = 2; a <= 4; ++a) set_a(a - 1, a, fmt::format("a{}", a));
  project().undo();
  EXPECT_EQ(folder.store(), edited_text(3));
  reopen();
  EXPECT_THAT(labels(), ElementsAre("+a2", "+a3", "-a4"));
  for (int k = 0; k < 3; ++k) project().undo();
  EXPECT_EQ(folder.store(), ProjectFolder::first_text);
  EXPECT_EQ(project().position(), 0u);
  reopen();
  EXPECT_THAT(labels(), ElementsAre("-a2", "-a3", "-a4"));
  project().redo();
  EXPECT_EQ(folder.store(), edited_text(2));
  project().go(3);
  project().redo();
  EXPECT_EQ(folder.store(), edited_text(4));
  project().go(1);
  EXPECT_EQ(folder.store(), edited_text(2));
  expect_input_error([&] { project().go(4); }, "the history: has 3 steps");
}

TEST_F(ProjectTest, AnEditDropsWhatIsUndone) {
  for (int a = 2; a <= 4; ++a) set_a(a - 1, a, fmt::format("a{}", a));
  project().go(1);
  set_a(2, 9, "a9");
  EXPECT_THAT(labels(), ElementsAre("+a2", "+a9"));
  reopen();
  EXPECT_THAT(labels(), ElementsAre("+a2", "+a9"));
  expect_first_text_at_0();
}

TEST_F(ProjectTest, QuickEditsOfTheSamePathsAreOneStep) {
  const auto nudge = [&](int from, const std::string& label = "Nudge") {
    project().edit(label, {to_set("/a", from, from + 1)}, true);
  };
  const auto nudge_b = [&](int from, int to, bool join = true) {
    project().edit("Nudge", {to_set("/b/0", from, to)}, join);
  };
  nudge(1);
  now += milliseconds(800);
  nudge(2);
  now += milliseconds(700);
  nudge(3);
  EXPECT_THAT(labels(), ElementsAre("+Nudge"));
  now += milliseconds(801);
  nudge(4);
  EXPECT_THAT(labels(), ElementsAre("+Nudge", "+Nudge")) << "too late";
  nudge(5, "Type");
  nudge(6);
  EXPECT_EQ(project().steps().size(), 4u) << "other labels";
  nudge_b(1, 2);
  EXPECT_EQ(project().steps().size(), 5u) << "another path";
  nudge_b(2, 3, false);
  EXPECT_EQ(project().steps().size(), 6u) << "without `join`";
  nudge_b(3, 5);
  EXPECT_EQ(project().steps().size(), 7u) << "after an edit without `join`";
  project().undo();
  project().undo();
  nudge_b(2, 4);
  EXPECT_EQ(project().steps().size(), 6u) << "after undo";
  reopen();
  nudge_b(4, 5);
  EXPECT_EQ(project().steps().size(), 7u) << "after a restart";
  project().go(1);
  EXPECT_EQ(folder.store(), edited_text(4));
  project().undo();
  EXPECT_EQ(folder.store(), ProjectFolder::first_text);
}

TEST_F(ProjectTest, AnEqualValueIsNoStep) {
  project().edit("Nothing", {to_set("/b/1", 2, 2.0)});
  EXPECT_THAT(project().steps(), IsEmpty());
  EXPECT_EQ(folder.lines().size(), 1u);
  project().undo();
  project().redo();
  EXPECT_EQ(project().revision(), 1u);
}

TEST_F(ProjectTest, RefusedEditsChangeNothing) {
  EXPECT_THROW(set_a(7, 2), EditConflict);
  expect_input_error(
      [&] { project().edit("All", {to_set("", Json::parse(folder.store(), nullptr, true, true), 1)}); },
      "store.json: is not a JSON object");
  expect_input_error([&] { project().edit("Large", {to_set("/a", 1, std::string(max_store_text, 'x'))}); },
                     "store.json: has 5,000,0", "the maximum is 5,000,000");
  EXPECT_EQ(folder.store(), ProjectFolder::first_text);
  EXPECT_EQ(folder.lines().size(), 1u);
  EXPECT_EQ(project().revision(), 1u);
}

TEST_F(ProjectTest, BytesThatAreNotUtf8AreKept) {
  const std::string text = "{ \"a\": \"\xC3\xA4\", // K\xFChl\n}";
  folder.write_store(text);
  EXPECT_TRUE(project().check_outside());
  project().edit("Change a", {to_set("/a", "\xC3\xA4", "\xC3\xB6")});
  folder.write_store("{ \"a\": 1 } // K\xFChl");
  EXPECT_TRUE(project().check_outside());
  reopen();
  EXPECT_EQ(project().steps().size(), 3u);
  project().go(1);
  EXPECT_EQ(folder.store(), text);
}

TEST_F(ProjectTest, TheCallerChecksEachText) {
  const auto refusing = [](int format) {
    return ProjectOptions{.check = [=](const Json& store) {
      if (store.value("format", 1) == format) throw InputError("store.json", "has the wrong format");
    }};
  };
  close();
  {
    Project checked(folder.path(), refusing(2));
    expect_input_error([&] { checked.edit("Format", {to_insert("/format", 2)}); }, "has the wrong format");
    folder.write_store("{ \"format\": 2 }");
    EXPECT_TRUE(checked.check_outside());
    EXPECT_EQ(checked.locked(), "store.json: has the wrong format");
    checked.restore_mine();
  }
  // Those of a history from elsewhere, too.
  reopen();
  project().edit("Format", {to_insert("/format", 2)});
  project().edit("Format", {to_set("/format", 2, 3)});
  close();
  expect_input_error([&] { Project project(folder.path(), refusing(3)); }, "has the wrong format");
  Project checked(folder.path(), refusing(2));
  expect_input_error([&] { checked.undo(); }, "has the wrong format");
  checked.go(0);
  EXPECT_EQ(folder.store(), ProjectFolder::first_text);
}

TEST_F(ProjectTest, ARemovedHistoryIsWrittenAnew) {
  set_a(1, 2, "a2");
  set_a(2, 3, "a3");
  project().undo();
  fs::remove_all(folder / ".shelfbeam");
  project().redo();
  project().undo();
  expect_input_error([&] { Project second(folder.path()); }, "is in use by another run of shelfbeam");
  reopen();
  EXPECT_THAT(labels(), ElementsAre("+a2", "-a3"));
}

TEST_F(ProjectTest, ARemovedHistoryThatAnotherProcessHasWrittenIsLeftAlone) {
  fs::remove_all(folder / ".shelfbeam");
  Project other(folder.path());
  expect_input_error([&] { set_a(1, 2); }, "is in use by another run");
  folder.write_store(edited_text(3));
  EXPECT_TRUE(project().check_outside());
  EXPECT_TRUE(project().locked());
  close();
  expect_input_error([&] { Project third(folder.path()); }, "is in use by another run");
  EXPECT_TRUE(other.check_outside());
  EXPECT_EQ(other.steps().size(), 1u);
}

TEST_F(ProjectTest, NeedsAStore) {
  close();
  for (const char* name : {"store.json", ".shelfbeam"}) fs::remove_all(folder / name);
  expect_input_error([&] { Project project(folder.path()); }, "store.json: does not exist");
  EXPECT_FALSE(fs::exists(folder / ".shelfbeam"));
}

TEST_F(ProjectTest, PermissionsAreKept) {
  const auto mine = fs::perms::owner_read | fs::perms::owner_write;
  fs::permissions(folder / "store.json", mine);
  set_a(1, 2);
  EXPECT_EQ(fs::status(folder / "store.json").permissions(), mine);
  EXPECT_EQ(fs::status(folder / ".shelfbeam").permissions(), fs::perms::owner_all);
}

}  // namespace
}  // namespace shelfbeam::serve
