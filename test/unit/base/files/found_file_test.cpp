#include "shelfbeam/base/files/found_file.hpp"

#include <cerrno>

#include <sys/stat.h>

#include "shelfbeam/base/file.hpp"

#include "support/testing.hpp"

namespace shelfbeam::test {
namespace {

namespace fs = std::filesystem;

class FoundFileTest : public testing::Test {
 protected:
  FoundFileTest() {
    folder.write("secret", "outside");
    folder.write("home/file", "inside");
    folder.write("home/deep/er/file", "deeper");
    fs::create_symlink("file", home / "link");
    fs::create_symlink("../secret", home / "out");
    fs::create_symlink("none", home / "dangling");
    fs::create_directory_symlink("deep", home / "short");
    fs::create_directory_symlink("..", home / "up");
    fs::create_directory_symlink("home", folder / "also");
  }
  FoundFile below(const fs::path& path) const { return find_file_below(home, path); }

  const TempFolder folder;
  const fs::path home = folder / "home";
};

TEST_F(FoundFileTest, IsOpenBelowAFolder) {
  const auto read = [&](const fs::path& path) { return InputFile(path, below(path)).read(); };
  for (const char* path : {"file", "./file", "deep/../file", "deep/er/../../file", "deep//er/..//../file"})
    EXPECT_EQ(read(path), "inside") << path;
  EXPECT_EQ(read("deep/er/file"), "deeper");
  EXPECT_EQ(InputFile("file", find_file_below(folder / "also", "file")).read(), "inside")
      << "the folder itself by a link";
}

TEST_F(FoundFileTest, IsNotBehindALink) {
  for (const char* path : {"link", "out", "dangling", "short/er/file", "short/../file", "up/secret",
                           "up/home/file", "deep/../short/er/file", "short/", "up"})
    EXPECT_EQ(below(path).error, ELOOP) << path;
}

TEST_F(FoundFileTest, IsNotOutside) {
  for (const fs::path& path : {fs::path("../secret"), fs::path("../home/file"), fs::path("deep/../../secret"),
                               fs::path(".."), folder / "secret", home / "file"})
    EXPECT_EQ(below(path).error, EXDEV) << path;
}

TEST_F(FoundFileTest, IsNotWhatIsMissing) {
  EXPECT_EQ(below("none").error, ENOENT);
  EXPECT_EQ(below("none/../file").error, ENOENT);
  EXPECT_EQ(below("file/").error, ENOTDIR);
  EXPECT_EQ(below("file/../file").error, ENOTDIR);
  EXPECT_EQ(below(std::string(10'000, 'a')).error, ENAMETOOLONG);
  EXPECT_EQ(find_file_below(folder / "none", "file").error, ENOENT);
}

// Opening the pipe would wait for a writer.
TEST_F(FoundFileTest, IsOpenOnlyIfItIsRegular) {
  ASSERT_EQ(::mkfifo((home / "pipe").c_str(), 0600), 0);
  for (const char* path : {"pipe", "deep", "deep/", ".", "deep/.."}) {
    for (const FoundFile& found : {below(path), find_file(home / path)}) {
      EXPECT_TRUE(found.exists() && !found.is_regular()) << path;
      EXPECT_FALSE(found.file.is_open()) << path;
    }
  }
}

TEST_F(FoundFileTest, StaysTheSameWhenItsNameMoves) {
  const InputFile file("file", below("file"));
  fs::rename(home / "file", home / "moved");
  fs::rename(folder / "secret", home / "file");
  EXPECT_EQ(file.read(), "inside");
  EXPECT_EQ(file.read(), "inside") << "again";
  fs::resize_file(home / "moved", 2);
  EXPECT_EQ(file.read(), "in");
}

}  // namespace
}  // namespace shelfbeam::test
