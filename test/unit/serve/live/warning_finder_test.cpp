#include "serve/live/warning_finder.hpp"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>

#include "support/temp_folder.hpp"

namespace shelfbeam::serve {
namespace {

using namespace std::chrono_literals;
using Clock = WarningFinder::Clock;

// A program that answers as `inspect --json` does, and writes down each of its runs.
std::filesystem::path program(const test::TempFolder& folder, const std::string& answer) {
  std::filesystem::path path = folder.path() / "program";
  std::ofstream(path) << "#!/bin/sh\necho run >> '" << (folder.path() / "runs").string() << "'\necho '"
                      << answer << "'\n";
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path;
}

std::optional<nlohmann::ordered_json> result(WarningFinder& finder, Clock::time_point now) {
  for (int k = 0; k < 1000; ++k) {
    if (auto found = finder.poll(now)) return found;
    std::this_thread::sleep_for(10ms);
  }
  return {};
}

TEST(WarningFinder, BeginsWhenTheFileIsQuiet) {
  const test::TempFolder folder;
  WarningFinder finder("store.json", program(folder, R"({"findings": [{"path": "room"}]})").string());
  const auto start = Clock::now();
  EXPECT_FALSE(finder.poll(start)) << "nothing has changed";
  finder.restart(start);
  finder.restart(start + 200ms);
  EXPECT_FALSE(finder.poll(start + 400ms));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "runs"));
  const auto found = result(finder, start + 600ms);
  ASSERT_TRUE(found);
  EXPECT_EQ((*found)[0]["path"], "room");
  EXPECT_FALSE(finder.poll(start + 10s)) << "once for each change";
}

TEST(WarningFinder, FindsNoneInAStoreWithProblems) {
  const test::TempFolder folder;
  WarningFinder finder("store.json", program(folder, R"({"problems": [1]})").string());
  finder.restart(Clock::now());
  const auto found = result(finder, Clock::now() + 1s);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->empty());
}

TEST(WarningFinder, SaysThatItsProgramFailed) {
  const test::TempFolder folder;
  WarningFinder finder("store.json", program(folder, "").string());
  finder.restart(Clock::now());
  const auto found = result(finder, Clock::now() + 1s);
  ASSERT_TRUE(found);
  ASSERT_EQ(found->size(), 1U);
  EXPECT_EQ((*found)[0]["code"], "not_checked");
}

}  // namespace
}  // namespace shelfbeam::serve
