#include <regex>

#include "shelfbeam/base/file.hpp"

#include "support/testing.hpp"

namespace shelfbeam::test {
namespace {

// Whether a text contains a flag; styles (var(--ink)) and flags of other programs are not ours.
bool words_a_flag(const std::string& line) {
  static const std::regex flag(R"re("([^"]*[^"(\w])?--[a-z][a-z-]+)re");
  return std::regex_search(line, flag) && line.find("h5repack") == std::string::npos;
}

TEST(LibraryTexts, ContainNoFlags) {
  int files = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(SHELFBEAM_SOURCE_DIR "/src/shelfbeam")) {
    if (!entry.is_regular_file()) continue;
    ++files;
    std::istringstream lines(read_file(entry.path()));
    for (std::string line; std::getline(lines, line);)
      EXPECT_FALSE(words_a_flag(line)) << entry.path() << ": " << line;
  }
  EXPECT_GT(files, 200);
}

TEST(LibraryTexts, FlagsAreSeen) {
  for (const char* line : {R"(fail("--memory", "is small");)", R"(fail("file", "set one with --threshold");)",
                           R"("resume with '--resume'")"})
    EXPECT_TRUE(words_a_flag(line)) << line;
  for (const char* line :
       {R"(/// --allow-outside, "as told".)", R"(("style=\"fill:var(--ink)\"");)", R"("--g{}:{};")"})
    EXPECT_FALSE(words_a_flag(line)) << line;
}

}  // namespace
}  // namespace shelfbeam::test
