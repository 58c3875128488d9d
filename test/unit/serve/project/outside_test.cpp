// Changes by other programs while a project is open, and between two openings.

#include <atomic>
#include <csignal>

#include "unit/serve/project/project_folder.hpp"

namespace shelfbeam::serve {
namespace {

constexpr std::string_view other_text = "{ \"a\": 1, \"c\": true }\n";

class OutsideChange : public OpenProject {
 protected:
  void edit() { set_a(1, 2); }
  void expect_locked(std::string_view reason) {
    ASSERT_TRUE(project().locked());
    EXPECT_THAT(*project().locked(), testing::HasSubstr(reason));
  }
};

TEST_F(OutsideChange, OfTheSameSizeAndTimeIsNoticed) {
  const auto time = fs::last_write_time(folder / "store.json");
  std::string text(ProjectFolder::first_text);
  text[text.find("1,")] = '7';
  folder.write_store(text);
  fs::last_write_time(folder / "store.json", time);
  EXPECT_TRUE(project().check_outside());
}

TEST_F(OutsideChange, JustBeforeAnEditIsTakenInFirst) {
  folder.write_store(other_text);
  edit();
  EXPECT_EQ(folder.store(), "{ \"a\": 2, \"c\": true }\n");
  EXPECT_EQ(project().steps().size(), 2u);
  folder.write_store(other_text);
  EXPECT_THROW(set_a(2, 3), EditConflict);
  EXPECT_EQ(folder.store(), other_text);
  EXPECT_EQ(project().steps().size(), 3u);
  expect_first_text_at_0();
}

TEST_F(OutsideChange, JustBeforeUndoIsNotUndone) {
  edit();
  folder.write_store(other_text);
  expect_input_error([&] { project().undo(); }, "store.json: was changed outside at the same time");
  EXPECT_EQ(folder.store(), other_text);
  EXPECT_EQ(project().position(), 2u);
}

// The project asks for the time between its look at the file and its own change.
TEST(OutsideChangeDuringAnEdit, IsTakenInFirst) {
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
TEST(OutsideChangeDuringAnEdit, IsNeverOverwritten) {
  const ProjectFolder folder("{ \"n\": 0, \"own\": 0 }");
  Project project(folder.path());
  std::atomic<int> seen = 0;
  constexpr int saves = 40;
  std::thread other([&] {
    for (int n = 1; n <= saves; ++n) {
      std::ofstream(folder / "other.json") << fmt::format("{{ \"n\": {}, \"own\": 0 }}", n);
      fs::rename(folder / "other.json", folder / "store.json");
      for (int wait = 0; seen < n && wait < 2000; ++wait) std::this_thread::sleep_for(milliseconds(1));
      if (seen < n) return;
    }
  });
  const auto end = std::chrono::steady_clock::now() + seconds(20);
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

TEST_F(OutsideChange, WhileNothingRunsIsAStep) {
  edit();
  reopen([&] { folder.write_store(other_text); });
  EXPECT_EQ(project().text(), other_text);
  EXPECT_EQ(project().position(), 2u);
  expect_first_text_at_0();
}

TEST_F(OutsideChange, ToAnEarlierTextIsAStep) {
  edit();
  reopen([&] {
    // Longer than a step of the time of any file system that tests run on.
    std::this_thread::sleep_for(milliseconds(20));
    folder.write_store(ProjectFolder::first_text);
  });
  EXPECT_EQ(folder.store(), ProjectFolder::first_text);
  EXPECT_EQ(project().position(), 2u);
}

TEST_F(OutsideChange, ThatIsInvalidLocks) {
  edit();
  const std::string mine = project().text();
  folder.write_store("{\n  \"a\": }\n");
  EXPECT_TRUE(project().check_outside());
  EXPECT_FALSE(project().check_outside()) << "still invalid";
  expect_locked("store.json: is not valid JSON (parse error at line 2, column 8");
  EXPECT_EQ(project().text(), mine);
  for (const auto& change : std::vector<std::function<void()>>{
           [&] { set_a(2, 3); }, [&] { project().undo(); }, [&] { project().go(0); }})
    expect_input_error(change, "the project: is locked", "line 2, column 8", "restore");
  EXPECT_EQ(folder.store(), "{\n  \"a\": }\n");
  folder.write_store(mine);
  EXPECT_TRUE(project().check_outside()) << "valid again";
  EXPECT_FALSE(project().locked());
  EXPECT_EQ(project().position(), 1u);
  // From an invalid text to another one.
  folder.write_store("{");
  EXPECT_TRUE(project().check_outside());
  folder.write_store(other_text);
  EXPECT_TRUE(project().check_outside());
  EXPECT_FALSE(project().locked());
  EXPECT_EQ(project().position(), 2u);
}

TEST_F(OutsideChange, RestoringKeepsTheOtherFile) {
  project().restore_mine();
  EXPECT_FALSE(fs::exists(folder / "store.json.outside-1")) << "nothing to restore";
  for (const std::string number : {"1", "2"}) {
    folder.write_store("{ " + number);
    EXPECT_TRUE(project().check_outside());
    project().restore_mine();
    EXPECT_FALSE(project().locked());
    EXPECT_EQ(folder.store(), ProjectFolder::first_text);
    EXPECT_EQ(read_file(folder / ("store.json.outside-" + number)), "{ " + number);
  }
  EXPECT_FALSE(project().check_outside());
  edit();
  EXPECT_EQ(read_file(folder / "store.json.outside-2"), "{ 2");
}

TEST_F(OutsideChange, ToALargeFileLocks) {
  folder.write_store("{}" + std::string(max_store_text, ' '));
  EXPECT_TRUE(project().check_outside());
  expect_locked("has 5,000,002 bytes; the maximum is 5,000,000");
}

TEST_F(OutsideChange, LinksAreNotFollowed) {
  const TempFolder elsewhere;
  const fs::path target = elsewhere.write("target", other_text);
  fs::remove(folder / "store.json");
  fs::create_symlink(target, folder / "store.json");
  EXPECT_TRUE(project().check_outside());
  expect_locked("store.json: is a symbolic link");
  reopen();
  expect_locked("store.json: is a symbolic link");
  project().restore_mine();
  EXPECT_EQ(folder.store(), ProjectFolder::first_text);
  EXPECT_FALSE(fs::is_symlink(folder / "store.json"));
  EXPECT_TRUE(fs::is_symlink(folder / "store.json.outside-1"));
  EXPECT_EQ(read_file(target), other_text);
}

TEST_F(OutsideChange, AFolderInThePlaceOfTheFileIsMoved) {
  fs::remove(folder / "store.json");
  fs::create_directory(folder / "store.json");
  EXPECT_TRUE(project().check_outside());
  project().restore_mine();
  EXPECT_EQ(folder.store(), ProjectFolder::first_text);
  EXPECT_TRUE(fs::is_directory(folder / "store.json.outside-1"));
}

TEST(ProjectFolderLinks, AreRefused) {
  const TempFolder elsewhere;
  const fs::path target = elsewhere.write("target", other_text);
  for (const auto& [link, problem] : {std::pair("store.json", "store.json: is a symbolic link"),
                                      {".shelfbeam", ".shelfbeam: is not a folder"},
                                      {".shelfbeam/history.jsonl", "history.jsonl: is a symbolic link"}}) {
    const ProjectFolder folder;
    const fs::path place = folder / link;
    fs::create_directories(place.parent_path());
    fs::remove(place);
    fs::create_symlink(place.extension().empty() ? elsewhere.path() : target, place);
    expect_input_error([&] { Project project(folder.path()); }, problem);
  }
  EXPECT_EQ(elsewhere.count(), 1);
}

// Limits the size of files, as a full disk does.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : limit_(RLIMIT_FSIZE, bytes) {}
  ~FullDisk() { std::signal(SIGXFSZ, old_handler_); }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  void (*old_handler_)(int) = std::signal(SIGXFSZ, SIG_IGN);
  ProcessLimit limit_;
};

class FullDiskTest : public OutsideChange {};

TEST_F(FullDiskTest, LeavesMemoryAndDiskAsTheyWere) {
  edit();
  const std::string text = project().text(), history = read_file(folder.history());
  // Nothing fits; the store fits, but only a part of the record; all but the last byte of the record fits.
  for (const std::size_t bytes :
       {std::size_t{0}, text.size() + 1, history.size() + 10, history.size() + 100}) {
    {
      const FullDisk full(bytes);
      EXPECT_THROW(set_a(2, 3), OutputError);
      EXPECT_THROW(project().undo(), OutputError);
    }
    EXPECT_EQ(project().text(), text);
    EXPECT_EQ(project().position(), 1u);
    EXPECT_EQ(project().revision(), 2u);
    EXPECT_EQ(folder.store(), text);
    EXPECT_EQ(read_file(folder.history()), history);
  }
  set_a(2, 3);
  project().undo();
  project().undo();
  EXPECT_EQ(folder.store(), ProjectFolder::first_text);
}

TEST_F(FullDiskTest, KeepsTheFileOfTheOtherProgram) {
  folder.write_store(other_text);
  {
    const FullDisk full(0);
    EXPECT_TRUE(project().check_outside());
    expect_locked("history.jsonl: cannot be written");
    EXPECT_FALSE(project().check_outside());
    EXPECT_THROW(project().restore_mine(), OutputError);
    EXPECT_EQ(folder.store(), other_text);
  }
  EXPECT_TRUE(project().check_outside());
  EXPECT_EQ(project().text(), other_text);
}

}  // namespace
}  // namespace shelfbeam::serve
