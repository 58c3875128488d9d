#include "shelfbeam/base/file.hpp"

#include <fstream>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "support/expect_input_error.hpp"
#include "support/temp_folder.hpp"

namespace shelfbeam {
namespace {

using test::expect_input_error;
using test::TempFolder;

TEST(ReadFile, GivesAllBytes) {
  const TempFolder folder;
  const std::string bytes("a\0\r\n\xff", 5);
  EXPECT_EQ(read_file(folder.write("bytes", bytes)), bytes);
  EXPECT_EQ(read_file(folder.write("empty", "")), "");
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

TEST(AtomicFile, RefusesWhereItCannotWrite) {
  const TempFolder folder;
  folder.write("file", "");
  expect_input_error([&] { AtomicFile(folder / "none/out.txt"); }, "none/out.txt", "cannot be written");
  expect_input_error([&] { AtomicFile(folder / "file/out.txt"); }, "file/out.txt", "cannot be written");
  expect_input_error([&] { AtomicFile(folder.path()); }, "it is a folder");
  expect_input_error([&] { write_file("/proc/shelfbeam", "x"); }, "/proc/shelfbeam: cannot be written");
  const std::string too_long(5000, 'x');
  expect_input_error([&] { AtomicFile(folder / too_long / "out.txt"); }, "cannot be written");
  expect_input_error([&] { read_file(folder / too_long); }, "cannot be read");
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  expect_input_error([&] { AtomicFile(folder / "pipe"); }, "pipe: cannot be written (it is no regular file)");
  EXPECT_TRUE(std::filesystem::is_fifo(folder / "pipe"));
  std::filesystem::remove(folder / "pipe");
  EXPECT_EQ(folder.count(), 1);
}

// Nobody makes files in /proc, root included.
TEST(AtomicFile, RefusesAReadOnlyFolder) {
  expect_input_error([] { AtomicFile("/proc/out.txt"); }, "out.txt: cannot be written");
  expect_input_error([] { make_output_folder("/proc/folder"); }, "cannot be written");
}

TEST(OutputFolder, IsMadeWithItsParents) {
  const TempFolder folder;
  make_output_folder(folder / "a/b/c");
  EXPECT_TRUE(std::filesystem::is_directory(folder / "a/b/c"));
  EXPECT_NO_THROW(make_output_folder(folder / "a/b/c"));
  const auto file = folder.write("file", "");
  expect_input_error([&] { make_output_folder(file); }, "file: cannot be written");
  expect_input_error([&] { make_output_folder(file / "below"); }, "cannot be written");
}

}  // namespace
}  // namespace shelfbeam
