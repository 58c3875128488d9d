#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "system/app/program.hpp"

namespace shelfbeam {
namespace {

const std::filesystem::path top = SHELFBEAM_SOURCE_DIR;

// Quoted paths exist, relative to the top or to src/shelfbeam.
TEST(Readme, PathsExist) {
  for (const char* name : {"README.md", "CONTRIBUTING.md"}) {
    const std::string page = read_file(top / name);
    const std::regex path("`([a-z][a-z_/]+/[a-z_-]+\\.[a-z]+)`");
    for (std::sregex_iterator found(page.begin(), page.end(), path), end; found != end; ++found) {
      const std::string target = (*found)[1];
      EXPECT_TRUE(std::filesystem::exists(top / target) ||
                  std::filesystem::exists(top / "src/shelfbeam" / target))
          << name << ": " << target;
    }
  }
}

TEST(Readme, IsShort) {
  const std::string page = read_file(top / "README.md");
  EXPECT_LE(std::ranges::count(page, '\n'), 90);
}

// All words of the C++ sources, without comments.
std::set<std::string> source_words() {
  std::set<std::string> words;
  const std::regex name("[A-Za-z_][A-Za-z0-9_]*");
  for (const auto& entry : std::filesystem::recursive_directory_iterator(top / "src/shelfbeam")) {
    if (!entry.is_regular_file()) continue;
    std::istringstream lines(read_file(entry.path()));
    for (std::string line; std::getline(lines, line);) {
      line.erase(std::min(line.size(), line.find("//")));
      words.insert(std::sregex_token_iterator(line.begin(), line.end(), name), std::sregex_token_iterator());
    }
  }
  return words;
}

std::vector<std::string> unknown_identifiers(const std::string& page, const std::set<std::string>& words) {
  std::vector<std::string> unknown;
  const std::regex last_cell("`([A-Za-z_:]+)` \\|\n"), name("[A-Za-z_]+");
  for (std::sregex_iterator cell(page.begin(), page.end(), last_cell), end; cell != end; ++cell) {
    const std::string qualified = (*cell)[1];
    for (std::sregex_iterator part(qualified.begin(), qualified.end(), name); part != end; ++part)
      if (!words.contains(part->str())) unknown.push_back(part->str());
  }
  return unknown;
}

TEST(Glossary, IdentifiersExist) {
  const std::string page = read_file(top / "docs/glossary.md");
  const std::set<std::string> words = source_words();
  EXPECT_EQ(unknown_identifiers(page, words), std::vector<std::string>{});
  EXPECT_EQ(unknown_identifiers("| a | b | c | `Scene::no_such_member` |\n", words),
            std::vector<std::string>{"no_such_member"});
}

}  // namespace
}  // namespace shelfbeam
