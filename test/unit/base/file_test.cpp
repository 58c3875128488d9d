#include "shelfbeam/base/file.hpp"

#include <chrono>
#include <thread>

#include <sys/stat.h>

#include "support/testing.hpp"

namespace shelfbeam::test {
namespace {

TEST(ReadFile, GivesAllBytes) {
  const TempFolder folder;
  const std::string bytes("a\0\r\n\xff", 5);
  EXPECT_EQ(read_file(folder.write("bytes", bytes)), bytes);
  EXPECT_EQ(read_file(folder.write("empty", "")), "");
}

TEST(ReadText, RemovesTheMark) {
  const TempFolder folder;
  EXPECT_EQ(read_text(folder.write("marked",
                                   "\xEF\xBB\xBF"
                                   "a\r\n")),
            "a\r\n");
  expect_input_error(
      [&] {
        read_text(folder.write("wide", std::string("\xFF\xFE"
                                                   "a\0",
                                                   4)));
      },
      "wide: is UTF-16");
}

TEST(ReadFile, RefusesNamesWithNullCharacters) {
  const TempFolder folder;
  const std::string name = folder.write("a", "secret").string() + std::string("\0.txt", 5);
  expect_input_error([&] { read_file(name); }, "a\\x00.txt: ", "null character");
}

TEST(AtomicFile, AppearsOnlyWhenCommitted) {
  const TempFolder folder;
  {
    AtomicFile file(folder / "out.txt");
    std::ofstream(file.temporary()) << "new";
    EXPECT_FALSE(std::filesystem::exists(folder / "out.txt"));
    file.commit();
    EXPECT_EQ(read_file(folder / "out.txt"), "new");
  }
  EXPECT_EQ(read_file(folder / "out.txt"), "new");
  EXPECT_EQ(folder.count(), 1);
}

mode_t mode_of(const std::filesystem::path& path) {
  struct stat state = {};
  return ::stat(path.c_str(), &state) == 0 ? state.st_mode & 07777 : 0;
}

TEST(AtomicFile, KeepsTheModeOfTheFileInItsPlace) {
  const TempFolder folder;
  const std::filesystem::path file = folder.write("out.txt", "old");
  for (const mode_t mode : {0600U, 0640U, 0666U, 0444U}) {
    ::chmod(file.c_str(), mode);
    write_file(file, "new");
    EXPECT_EQ(mode_of(file), mode);
  }
}

TEST(OutputFolder, IsOpenToItsGroup) {
  const TempFolder folder;
  const mode_t mask = ::umask(077);
  for (const mode_t mode : {02770U, 02750U, 0770U}) {
    ::chmod(folder.path().c_str(), mode);
    const std::filesystem::path made = folder / std::to_string(mode);
    make_output_folder(made / "deep");
    write_file(made / "deep/file", "content");
    const bool is_shared = mode == 02770;
    EXPECT_EQ(mode_of(made) & 0777, is_shared ? 0770u : 0700u) << mode;
    EXPECT_EQ(mode_of(made / "deep") & 0777, is_shared ? 0770u : 0700u) << mode;
    EXPECT_EQ(mode_of(made / "deep/file"), is_shared ? 0660u : 0600u) << mode;
  }
  ::umask(mask);
}

TEST(AtomicFile, KeepsTheOldFileWithoutCommit) {
  const TempFolder folder;
  const auto path = folder.write("out.txt", "old");
  {
    AtomicFile file(path);
    std::ofstream(file.temporary()) << "half of the ne";
  }
  EXPECT_EQ(read_file(path), "old");
  EXPECT_EQ(folder.count(), 1) << "the temporary file must be gone";
  write_file(path, "new");
  EXPECT_EQ(read_file(path), "new");
  EXPECT_EQ(folder.count(), 1);
}

TEST(AtomicFile, ReplacesOnlyTheExpectedContent) {
  const TempFolder folder;
  const auto path = folder.write("out.txt", "old");
  for (const std::string_view expected : {"other", "ol", "old"}) {
    AtomicFile file(path);
    file.write("new");
    EXPECT_EQ(file.commit_over(expected), expected == "old");
    EXPECT_EQ(read_file(path), expected == "old" ? "new" : "old");
  }
  std::filesystem::remove(path);
  AtomicFile file(path);
  EXPECT_FALSE(file.commit_over("new"));
  EXPECT_FALSE(std::filesystem::exists(path));
  std::filesystem::create_symlink(folder.write("target", "new"), path);
  EXPECT_FALSE(file.commit_over("new"));
  EXPECT_TRUE(std::filesystem::is_symlink(path));
}

// Another program saves at all moments of a commit, which takes a while because the file is large.
TEST(AtomicFile, NeverReplacesAnUnexpectedContent) {
  using Clock = std::chrono::steady_clock;
  const TempFolder folder;
  const std::string old(std::size_t{4} << 20, 'x');
  Clock::duration whole{};
  constexpr int moments = 40;
  for (int moment = 0; moment <= moments; ++moment) {
    const auto path = folder.write("out.txt", old);
    AtomicFile file(path);
    file.write("new");
    const auto begin = Clock::now();
    std::thread other([&, wait = whole * moment / moments] {
      if (moment == 0) return;
      const auto saved = folder.write("saved", "other");
      while (Clock::now() < begin + wait) std::this_thread::yield();
      std::filesystem::rename(saved, path);
    });
    const bool is_replaced = file.commit_over(old);
    if (moment == 0) whole = Clock::now() - begin;
    other.join();
    ASSERT_TRUE(is_replaced || moment > 0);
    ASSERT_EQ(read_file(path), moment == 0 ? "new" : "other") << moment;
  }
}

TEST(AtomicFile, TwoWritersDoNotMix) {
  const TempFolder folder;
  AtomicFile first(folder / "out.txt"), second(folder / "out.txt");
  EXPECT_NE(first.temporary(), second.temporary());
  std::ofstream(first.temporary()) << "first";
  std::ofstream(second.temporary()) << "second";
  second.commit();
  first.commit();
  EXPECT_EQ(read_file(folder / "out.txt"), "first");
}

TEST(AtomicFile, RefusesUnwritablePaths) {
  const TempFolder folder;
  folder.write("file", "");
  expect_input_error([&] { AtomicFile(folder / "none/out.txt"); }, "none/out.txt");
  expect_input_error([&] { AtomicFile(folder / "file/out.txt"); }, "file/out.txt");
  expect_input_error([&] { AtomicFile(folder.path()); }, folder.path().string());
  // Not even root can create files in /proc.
  expect_input_error([&] { write_file("/proc/shelfbeam", "x"); }, "/proc/shelfbeam: ");
  const std::string too_long(5000, 'x');
  expect_input_error([&] { AtomicFile(folder / too_long / "out.txt"); }, too_long);
  expect_input_error([&] { read_file(folder / too_long); }, too_long);
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  expect_input_error([&] { AtomicFile(folder / "pipe"); }, "pipe: ");
  EXPECT_TRUE(std::filesystem::is_fifo(folder / "pipe"));
  std::filesystem::remove(folder / "pipe");
  EXPECT_EQ(folder.count(), 1);
}

// The temporary file of a killed program has no lock and is removed. The file of a running program is locked
// and stays.
TEST(AtomicFile, RemovesOnlyFilesOfKilledWriters) {
  const TempFolder folder;
  folder.write(".out.txt.shelfbeam-a1B2c3", "half");
  folder.write(".out.txt.shelfbeam-notes", "of somebody else");
  folder.write(".out.txt.backup", "of somebody else");
  folder.write(".other.txt.shelfbeam-a1B2c3", "half of another");
  AtomicFile living(folder / "out.txt");
  living.write("living");
  EXPECT_EQ(folder.count(), 4);
  write_file(folder / "out.txt", "new");
  EXPECT_EQ(folder.count(), 5);
  living.commit();
  EXPECT_EQ(read_file(folder / "out.txt"), "living");
  EXPECT_FALSE(std::filesystem::exists(folder / ".out.txt.shelfbeam-a1B2c3"));
  remove_abandoned(folder / "other.txt");
  EXPECT_EQ(folder.count(), 3);
}

TEST(AtomicFile, ReportsThatAnOlderFileStays) {
  const TempFolder folder;
  const auto path = folder.write("out.txt", "old");
  AtomicFile file(path);
  std::filesystem::remove(file.temporary());
  expect_input_error([&] { file.commit(); }, "out.txt: ", "No such file or directory", "unchanged");
  EXPECT_EQ(read_file(path), "old");
}

TEST(AtomicFolder, ChangesNothingBeforeTheCommit) {
  const TempFolder folder;
  for (const char* name : {"first", "gone", "last"}) folder.write(name, "old");
  {
    AtomicFolder files(folder.path());
    files.add("first").write("new");
    files.add("last").write("new");
  }
  EXPECT_EQ(folder.count(), 3);
  EXPECT_EQ(read_file(folder / "first"), "old");
  AtomicFolder files(folder.path());
  files.add("first").write("new");
  files.add("last").write("new");
  files.commit({"last", "gone", "never there"});
  EXPECT_EQ(folder.count(), 2);
  EXPECT_EQ(read_file(folder / "first"), "new");
  EXPECT_EQ(read_file(folder / "last"), "new");
}

// If any renaming fails, the old files are restored, a new file without a predecessor is removed, and no
// other file remains.
TEST(AtomicFolder, RestoresAllFilesIfARenameFails) {
  for (const std::string failing : {"first", "second", "last"}) {
    SCOPED_TRACE(failing);
    const TempFolder folder;
    for (const char* name : {"first", "gone", "last"}) folder.write(name, "old");
    AtomicFolder files(folder.path());
    for (const std::string name : {"first", "second", "last"}) {
      AtomicFile& file = files.add(name);
      file.write("new");
      if (name == failing) std::filesystem::remove(file.temporary());
    }
    expect_input_error([&] { files.commit({"last", "gone"}); }, failing + ": ");
    for (const char* name : {"first", "gone", "last"}) EXPECT_EQ(read_file(folder / name), "old") << name;
    EXPECT_FALSE(std::filesystem::exists(folder / "second"));
    EXPECT_EQ(folder.count(), 3 + (failing == "first" ? 2 : failing == "second" ? 1 : 0));
  }
}

TEST(OutputFolder, IsMadeWithItsParents) {
  const TempFolder folder;
  make_output_folder(folder / "a/b/c");
  EXPECT_TRUE(std::filesystem::is_directory(folder / "a/b/c"));
  EXPECT_NO_THROW(make_output_folder(folder / "a/b/c"));
  const auto file = folder.write("file", "");
  expect_input_error([&] { make_output_folder(file); }, "file: ");
  expect_input_error([&] { make_output_folder(file / "below"); }, "below: ");
  expect_input_error([] { make_output_folder("/proc/folder"); }, "/proc/folder: ");
}

TEST(Files, ExpectsRoomOnTheDisk) {
  const TempFolder folder;
  EXPECT_NO_THROW(expect_room(folder.path(), 1));
  expect_input_error([&] { expect_room(folder.path(), 1e24); }, "1e+18 MB of disk space are needed",
                     " are free");
}

TEST(Files, OnlyRegularFilesOfALimitedSizeAreRead) {
  const TempFolder folder;
  const auto file = folder.write("a", "12345");
  EXPECT_EQ(read_file(file, 5), "12345");
  EXPECT_EQ(input_size(file), 5U);
  expect_input_error([&] { read_file(file, 4); }, "has 5 bytes", "the maximum is 4");
  expect_input_error([&] { read_file("/dev/zero"); }, "/dev/zero", "is not a regular file");
  expect_input_error([&] { read_file(folder.path()); }, "is a folder", "");
  expect_input_error([&] { read_file(folder / "none"); }, "cannot be read (", "");
}

TEST(FormatVersion, OfTheProgramAloneIsAccepted) {
  EXPECT_NO_THROW(expect_format_version("a.file", 3, 3));
  expect_input_error([] { expect_format_version("a.file", 4, 3); }, "a.file: ", "4", "newer");
  expect_input_error([] { expect_format_version("a.file", 2, 3); }, "a.file: ", "2", "wrote it");
}

}  // namespace
}  // namespace shelfbeam::test
