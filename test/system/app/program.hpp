#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/file.hpp"

#include "support/process.hpp"
#include "support/temp_folder.hpp"

namespace shelfbeam::test {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

inline std::vector<std::string> command(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), SHELFBEAM_BINARY);
  return arguments;
}

/// Runs the built program.
inline Outcome shelfbeam(std::vector<std::string> arguments) {
  return run(command(std::move(arguments)));
}

/// The words of a command line, separated by blanks; "@name" stands for a path in the folder.
inline std::vector<std::string> words(const TempFolder& folder, const std::string& line) {
  std::vector<std::string> words;
  std::istringstream stream(line);
  for (std::string word; stream >> word;)
    words.push_back(word[0] == '@' ? (folder / word.substr(1)).string() : word);
  return words;
}

/// Runs the program and expects the exit code and, because there is no terminal, an empty standard error.
inline std::string expect_silent(std::vector<std::string> arguments, int exit_code = 0) {
  const std::string what = testing::PrintToString(arguments);
  const Outcome outcome = shelfbeam(std::move(arguments));
  EXPECT_EQ(outcome.exit_code, exit_code) << what << '\n' << outcome.err;
  EXPECT_EQ(outcome.err, "") << what;
  return outcome.out;
}

/// Names and bytes of all files below a folder, hidden ones included.
inline std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> result;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    result[fs::relative(entry.path(), folder).string()] =
        entry.is_regular_file() ? read_file(entry.path()) : "";
  return result;
}

inline std::set<std::string> names(const fs::path& folder) {
  std::set<std::string> result;
  for (const auto& [name, content] : contents(folder)) result.insert(name);
  return result;
}

/// Expects one line on standard error that contains all `parts`, nothing on standard output, the exit code,
/// and unchanged files in the folder.
inline void expect_refused(const TempFolder& folder, const std::vector<std::string>& arguments,
                           const std::vector<std::string>& parts, int exit_code = 2) {
  const std::string what = testing::PrintToString(arguments);
  const auto before = contents(folder.path());
  const Outcome outcome = shelfbeam(arguments);
  EXPECT_EQ(outcome.exit_code, exit_code) << what << '\n' << outcome.err;
  EXPECT_EQ(outcome.out, "") << what;
  EXPECT_TRUE(outcome.err.starts_with("error: ")) << what << '\n' << outcome.err;
  EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << what << '\n' << outcome.err;
  for (const std::string& part : parts)
    EXPECT_NE(outcome.err.find(part), std::string::npos)
        << what << "\n'" << part << "' is not in: " << outcome.err;
  EXPECT_TRUE(contents(folder.path()) == before) << what << ": files changed, appeared or vanished";
}

/// A room of 8 x 6 x 3 m with a gondola, 17 labels and 12 candidates, none of which reaches all labels alone.
inline Json small_store() {
  return Json::parse(R"({
    "name": "Kiosk",
    "room": { "size": [8, 6, 3], "floor": "m", "ceiling": "m", "walls": "m" },
    "materials": { "m": { "type": "lambertian", "reflectance": 0.3 } },
    "label_types": { "standard": { "threshold": 0.03 } },
    "transceiver_types": { "ceiling": { "emission": { "type": "sin2theta", "peak": 1 } } },
    "fixtures": [ { "type": "gondola", "id": "A", "at": [2, 2.5], "length": 4, "depth": 0.9, "height": 1.8,
                    "material": "m", "shelves": [0.5, 1.2], "labels": { "type": "standard", "spacing": 1 } } ],
    "labels": [ { "id": "door", "position": [0.1, 3, 1.5], "normal": [1, 0, 0], "type": "standard" } ],
    "transceivers": { "grids": [ { "type": "ceiling", "min": [1, 1], "max": [7, 5], "spacing": 2, "z": 2.9 } ] }
  })");
}

/// A test with a temporary folder in which store.json is the small store.
class ProgramTest : public testing::Test {
 protected:
  ProgramTest() { folder.write("store.json", small_store().dump()); }
  std::string path(const std::string& name) const { return (folder / name).string(); }
  std::string bytes(const std::string& name) const { return read_file(folder / name); }
  Json json(const std::string& name) const { return Json::parse(bytes(name)); }
  std::string told(const std::string& line, int exit_code = 0) const {
    return expect_silent(words(folder, line), exit_code);
  }
  void refused(const std::string& line, const std::vector<std::string>& parts, int exit_code = 2) const {
    expect_refused(folder, words(folder, line), parts, exit_code);
  }
  TempFolder folder;
};

}  // namespace shelfbeam::test
