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

// The commands in README's shell blocks that run the program, in the order of the page.
std::vector<std::vector<std::string>> readme_commands() {
  std::vector<std::vector<std::string>> commands;
  std::istringstream page(read_file(top / "README.md"));
  bool in_block = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("```")) in_block = line == "```sh";
    if (!in_block || !line.starts_with("build/release/shelfbeam ")) continue;
    std::istringstream words(line.substr(0, line.find('#')));
    std::vector<std::string> arguments;
    for (std::string word; words >> word;) arguments.push_back(word);
    arguments.erase(arguments.begin());
    commands.push_back(std::move(arguments));
  }
  return commands;
}

// Slow, because it plans the grocery store, which takes up to minutes, as README states.
TEST(ReadmeSlow, CommandsWorkInTheirOrder) {
  const test::TempFolder folder;
  folder.write("matrix.csv", ",T1,T2,T3\nL1,0.03,0,0.01\nL2,0,0.05,0.015\n");
  const auto commands = readme_commands();
  ASSERT_GE(commands.size(), 5u);
  for (std::vector<std::string> command : commands) {
    for (std::string& word : command)
      if (word.starts_with("my-store") || word == "matrix.csv" || word == "model.mps")
        word = (folder / word).string();
    const test::Outcome outcome = test::shelfbeam(command);
    EXPECT_TRUE(outcome.exit_code == 0 || (command.front() == "plan" && outcome.exit_code == 3))
        << testing::PrintToString(command) << '\n'
        << outcome.err;
  }
  for (const char* name :
       {"my-store/plan.svg", "my-store/plan/report.html", "my-store/plan/placement.csv", "model.mps"})
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
}

TEST(Readme, LinksAreValid) {
  for (const char* name : {"README.md", "CONTRIBUTING.md"}) {
    const std::string page = read_file(top / name);
    for (std::size_t at = page.find("]("); at != std::string::npos; at = page.find("](", at + 1)) {
      const std::string target = page.substr(at + 2, page.find(')', at) - at - 2);
      EXPECT_TRUE(std::filesystem::exists(top / target)) << name << ": " << target;
    }
    // Quoted paths exist as well, relative to the top or to src/shelfbeam.
    const std::regex path("`([a-z][a-z_/]+/[a-z_-]+\\.[a-z]+)`");
    for (std::sregex_iterator found(page.begin(), page.end(), path), end; found != end; ++found) {
      const std::string target = (*found)[1];
      EXPECT_TRUE(std::filesystem::exists(top / target) ||
                  std::filesystem::exists(top / "src/shelfbeam" / target))
          << name << ": " << target;
    }
  }
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
