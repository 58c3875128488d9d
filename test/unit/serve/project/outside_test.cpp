// Changes by other programs while a project is open, and between two openings.

#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "project_folder.hpp"
#include "serve/project/project.hpp"
#include "support/expect_input_error.hpp"
#include "unit/serve/text/edit_ops.hpp"

namespace shelfbeam::serve {
namespace {

namespace fs = std::filesystem;
using test::expect_input_error;

constexpr std::string_view other_text = "{ \"a\": 1, \"c\": true }\n";

TEST(OutsideChange, IsAStep) {
  const ProjectFolder folder;
  Project project(folder.path());
  EXPECT_FALSE(project.check_outside());
  folder.write_store(other_text);
  EXPECT_TRUE(project.check_outside());
  EXPECT_FALSE(project.check_outside());
  EXPECT_EQ(project.text(), other_text);
  EXPECT_EQ(project.revision(), 2u);
  EXPECT_EQ(project.steps().at(0).label, "Changed outside");
  project.undo();
  EXPECT_EQ(folder.store(), ProjectFolder::first_text);
  project.redo();
  EXPECT_EQ(folder.store(), other_text);
}

TEST(OutsideChange, OfTheSameSizeAndTimeIsNoticed) {
  const ProjectFolder folder;
  Project project(folder.path());
  const auto time = fs::last_write_time(folder / "store.json");
  std::string text(ProjectFolder::first_text);
  text[text.find("1,")] = '7';
  folder.write_store(text);
  fs::last_write_time(folder / "store.json", time);
  EXPECT_TRUE(project.check_outside());
}

TEST(OutsideChange, JustBeforeAnEditIsTakenInFirst) {
  const ProjectFolder folder;
  Project project(folder.path());
  folder.write_store(other_text);
  project.edit("Change a", {to_set("/a", 1, 2)});
  EXPECT_EQ(folder.store(), "{ \"a\": 2, \"c\": true }\n");
  EXPECT_EQ(project.steps().size(), 2u);
  folder.write_store(other_text);
  EXPECT_THROW(project.edit("Change a", {to_set("/a", 2, 3)}), EditConflict);
  EXPECT_EQ(folder.store(), other_text);
  EXPECT_EQ(project.steps().size(), 3u);
  project.go(0);
  EXPECT_EQ(folder.store(), ProjectFolder::first_text);
}

TEST(OutsideChange, JustBeforeUndoIsNotUndone) {
  const ProjectFolder folder;
  Project project(folder.path());
  project.edit("Change a", {to_set("/a", 1, 2)});
  folder.write_store(other_text);
  expect_input_error([&] { project.undo(); }, "store.json: was changed outside at the same time");
  EXPECT_EQ(folder.store(), other_text);
  EXPECT_EQ(project.position(), 2u);
}

// The project asks for the time between its look at the file and its own change.
TEST(OutsideChange, DuringAnEditIsTakenInFirst) {
  const ProjectFolder folder;
  int interruptions = 0;
  const auto interrupt = [&] {
    if (interruptions > 0) folder.write_store(fmt::format("{{ \"a\": 1, \"c\": {} }}", --interruptions));
    return std::chrono::system_clock::now();
  };
  {
    Project project(folder.path(), {.now = interrupt});
    interruptions = 1;
    project.edit("Change a", {to_set("/a", 1, 2)});
    EXPECT_EQ(folder.store(), "{ \"a\": 2, \"c\": 0 }");
    EXPECT_EQ(project.steps().size(), 2u);
    interruptions = 1;
    expect_input_error([&] { project.go(0); }, "store.json: was changed outside at the same time");
    EXPECT_EQ(project.text(), "{ \"a\": 1, \"c\": 0 }");
    interruptions = 10;
    expect_input_error([&] { project.edit("Change a", {to_set("/a", 1, 2)}); },
                       "store.json: is being changed by another program");
    interruptions = 0;
  }
  Project project(folder.path());
  EXPECT_EQ(project.text(), folder.store());
  project.go(0);
  EXPECT_EQ(folder.store(), ProjectFolder::first_text);
}

// Another program saves again and again, each time after its text has been seen.
TEST(OutsideChange, AtNoMomentOfAnEditIsOverwritten) {
  const ProjectFolder folder("{ \"n\": 0, \"own\": 0 }");
  Project project(folder.path());
  std::atomic<int> seen = 0;
  constexpr int saves = 40;
  std::thread other([&] {
    for (int n = 1; n <= saves; ++n) {
      std::ofstream(folder / "other.json") << fmt::format("{{ \"n\": {}, \"own\": 0 }}", n);
      fs::rename(folder / "other.json", folder / "store.json");
      for (int wait = 0; seen < n && wait < 2000; ++wait)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      if (seen < n) return;
    }
  });
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  for (int k = 0; seen < saves && std::chrono::steady_clock::now() < end; ++k) {
    const Json now = Json::parse(project.text());
    seen = now["n"].get<int>();
    try {
      project.edit("Own", {to_set("/own", now["own"], now["own"].get<int>() + 1)});
    } catch (const InputError&) {  // the text was changed just before
    }
  }
  other.join();
  EXPECT_EQ(seen, saves);
}

TEST(OutsideChange, WhileNothingRunsIsAStep) {
  const ProjectFolder folder;
  {
    Project(folder.path()).edit("Change a", {to_set("/a", 1, 2)});
  }
  folder.write_store(other_text);
  Project project(folder.path());
  EXPECT_EQ(project.text(), other_text);
  EXPECT_EQ(project.position(), 2u);
  project.go(0);
  EXPECT_EQ(folder.store(), ProjectFolder::first_text);
}

TEST(OutsideChange, ToAnEarlierTextIsAStep) {
  const ProjectFolder folder;
  {
    Project(folder.path()).edit("Change a", {to_set("/a", 1, 2)});
  }
  // Longer than a step of the time of any file system that tests run on.
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  folder.write_store(ProjectFolder::first_text);
  const Project project(folder.path());
  EXPECT_EQ(folder.store(), ProjectFolder::first_text);
  EXPECT_EQ(project.position(), 2u);
}

TEST(OutsideChange, ThatIsInvalidLocks) {
  const ProjectFolder folder;
  Project project(folder.path());
  project.edit("Change a", {to_set("/a", 1, 2)});
  const std::string mine = project.text();
  folder.write_store("{\n  \"a\": }\n");
  EXPECT_TRUE(project.check_outside());
  EXPECT_FALSE(project.check_outside()) << "still invalid";
  ASSERT_TRUE(project.locked());
  EXPECT_NE(project.locked()->find("store.json: is not valid JSON (parse error at line 2, column 8"),
            std::string::npos)
      << *project.locked();
  EXPECT_EQ(project.text(), mine);
  for (const auto& change :
       std::initializer_list<std::function<void()>>{[&] { project.edit("Change a", {to_set("/a", 2, 3)}); },
                                                    [&] { project.undo(); }, [&] { project.go(0); }})
    expect_input_error(change, "the project: is locked", "line 2, column 8", "restore");
  EXPECT_EQ(folder.store(), "{\n  \"a\": }\n");
  folder.write_store(mine);
  EXPECT_TRUE(project.check_outside()) << "valid again";
  EXPECT_FALSE(project.locked());
  EXPECT_EQ(project.position(), 1u);
  project.undo();
}

TEST(OutsideChange, FromInvalidToAnotherTextIsAStep) {
  const ProjectFolder folder;
  Project project(folder.path());
  folder.write_store("{");
  EXPECT_TRUE(project.check_outside());
  folder.write_store(other_text);
  EXPECT_TRUE(project.check_outside());
  EXPECT_FALSE(project.locked());
  EXPECT_EQ(project.position(), 1u);
}

TEST(OutsideChange, RestoringKeepsTheOtherFile) {
  const ProjectFolder folder;
  Project project(folder.path());
  project.restore_mine();
  EXPECT_FALSE(fs::exists(folder / "store.json.outside-1")) << "nothing to restore";
  for (const std::string number : {"1", "2"}) {
    folder.write_store("{ " + number);
    EXPECT_TRUE(project.check_outside());
    project.restore_mine();
    EXPECT_FALSE(project.locked());
    EXPECT_EQ(folder.store(), ProjectFolder::first_text);
    EXPECT_EQ(read_file(folder / ("store.json.outside-" + number)), "{ " + number);
  }
  EXPECT_FALSE(project.check_outside());
  project.edit("Change a", {to_set("/a", 1, 2)});
  EXPECT_EQ(read_file(folder / "store.json.outside-2"), "{ 2");
}

TEST(OutsideChange, ARemovedFileLocks) {
  const ProjectFolder folder;
  {
    Project project(folder.path());
    fs::remove(folder / "store.json");
    EXPECT_TRUE(project.check_outside());
    EXPECT_FALSE(project.check_outside());
    expect_input_error([&] { project.edit("Change a", {to_set("/a", 1, 2)}); }, "store.json: was removed");
  }
  Project project(folder.path());
  EXPECT_TRUE(project.locked()) << "after a restart";
  project.restore_mine();
  EXPECT_EQ(folder.store(), ProjectFolder::first_text);
  EXPECT_FALSE(project.locked());
}

TEST(OutsideChange, ToALargeFileLocks) {
  const ProjectFolder folder;
  Project project(folder.path());
  folder.write_store("{}" + std::string(max_store_text, ' '));
  EXPECT_TRUE(project.check_outside());
  EXPECT_NE(project.locked()->find("has 5,000,002 bytes; the maximum is 5,000,000"), std::string::npos);
}

TEST(OutsideChange, LinksAreNotFollowed) {
  const ProjectFolder folder;
  const test::TempFolder elsewhere;
  const fs::path target = elsewhere.write("target", other_text);
  {
    Project project(folder.path());
    fs::remove(folder / "store.json");
    fs::create_symlink(target, folder / "store.json");
    EXPECT_TRUE(project.check_outside());
    EXPECT_NE(project.locked()->find("store.json: is a symbolic link"), std::string::npos);
  }
  Project project(folder.path());
  EXPECT_TRUE(project.locked()) << "after a restart";
  project.restore_mine();
  EXPECT_EQ(folder.store(), ProjectFolder::first_text);
  EXPECT_FALSE(fs::is_symlink(folder / "store.json"));
  EXPECT_TRUE(fs::is_symlink(folder / "store.json.outside-1"));
  EXPECT_EQ(read_file(target), other_text);
}

TEST(OutsideChange, AFolderInThePlaceOfTheFileIsMoved) {
  const ProjectFolder folder;
  Project project(folder.path());
  fs::remove(folder / "store.json");
  fs::create_directory(folder / "store.json");
  EXPECT_TRUE(project.check_outside());
  project.restore_mine();
  EXPECT_EQ(folder.store(), ProjectFolder::first_text);
  EXPECT_TRUE(fs::is_directory(folder / "store.json.outside-1"));
}

TEST(ProjectFolderLinks, AreRefused) {
  const test::TempFolder elsewhere;
  const fs::path target = elsewhere.write("target", other_text);
  {
    const ProjectFolder folder;
    fs::remove(folder / "store.json");
    fs::create_symlink(target, folder / "store.json");
    expect_input_error([&] { Project project(folder.path()); }, "store.json: is a symbolic link");
  }
  {
    const ProjectFolder folder;
    fs::create_directory_symlink(elsewhere.path(), folder / ".shelfbeam");
    expect_input_error([&] { Project project(folder.path()); }, ".shelfbeam: is not a folder");
  }
  {
    const ProjectFolder folder;
    fs::create_directory(folder / ".shelfbeam");
    fs::create_symlink(target, folder.history());
    expect_input_error([&] { Project project(folder.path()); }, "history.jsonl: is a symbolic link");
  }
  EXPECT_EQ(elsewhere.count(), 1);
}

// Limits the size of files, as a full disk does.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{bytes, old_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, old_handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  void (*old_handler_)(int);
  rlimit old_{};
};

TEST(FullDisk, LeavesMemoryAndDiskAsTheyWere) {
  const ProjectFolder folder;
  Project project(folder.path());
  project.edit("Change a", {to_set("/a", 1, 2)});
  const std::string text = project.text(), history = read_file(folder.history());
  // Nothing fits; the store fits, but only a part of the record; all but the last byte of the record fits.
  for (const std::size_t bytes :
       {std::size_t{0}, text.size() + 1, history.size() + 10, history.size() + 100}) {
    {
      const FullDisk full(bytes);
      EXPECT_THROW(project.edit("Change a", {to_set("/a", 2, 3)}), OutputError);
      EXPECT_THROW(project.undo(), OutputError);
    }
    EXPECT_EQ(project.text(), text);
    EXPECT_EQ(project.position(), 1u);
    EXPECT_EQ(project.revision(), 2u);
    EXPECT_EQ(folder.store(), text);
    EXPECT_EQ(read_file(folder.history()), history);
  }
  project.edit("Change a", {to_set("/a", 2, 3)});
  project.undo();
  project.undo();
  EXPECT_EQ(folder.store(), ProjectFolder::first_text);
}

TEST(FullDisk, OutsideChangeWaits) {
  const ProjectFolder folder;
  Project project(folder.path());
  folder.write_store(other_text);
  {
    const FullDisk full(0);
    EXPECT_TRUE(project.check_outside());
    EXPECT_NE(project.locked().value_or("").find("history.jsonl: cannot be written"), std::string::npos);
    EXPECT_FALSE(project.check_outside()) << "nothing new";
    EXPECT_THROW(project.restore_mine(), OutputError);
    EXPECT_EQ(folder.store(), other_text);
  }
  EXPECT_TRUE(project.check_outside());
  EXPECT_FALSE(project.locked());
  EXPECT_EQ(project.text(), other_text);
}

}  // namespace
}  // namespace shelfbeam::serve
