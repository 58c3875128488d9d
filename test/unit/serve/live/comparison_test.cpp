#include "serve/live/comparison.hpp"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shelfbeam/base/error.hpp"

#include "support/expect_input_error.hpp"
#include "support/temp_folder.hpp"

namespace shelfbeam::serve {
namespace {

namespace fs = std::filesystem;

using test::expect_input_error;
using test::TempFolder;

nlohmann::ordered_json result_of(Comparison& comparison) {
  for (int k = 0; k < 2000; ++k) {
    if (auto summary = comparison.poll()) return *summary;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return {};
}

void add_plan(const TempFolder& folder, const std::string& name) {
  folder.write(name + "/placement.json", "{}");
  folder.write(name + "/signal.h5", "");
}

TEST(Comparison, NeedsAPlanAndAFileInTheFolder) {
  const TempFolder folder;
  folder.write("inner/measured.csv", "label,signal\n");
  folder.write("secret.csv", "label,signal\n");
  const fs::path inner = folder / "inner";
  Comparison comparison(inner);
  expect_input_error([&] { comparison.start("measured.csv", false); }, "has no plan; run 'shelfbeam plan");
  // A plan behind links is none.
  add_plan(folder, "outer");
  fs::create_directory_symlink("../outer", inner / "linked");
  fs::create_directory(inner / "plan");
  fs::create_symlink("../../outer/signal.h5", inner / "plan" / "signal.h5");
  folder.write("inner/plan/placement.json", "{}");
  expect_input_error([&] { comparison.start("measured.csv", false); }, "has no plan");
  add_plan(folder, "inner/real");
  expect_input_error([&] { comparison.start("../secret.csv", false); }, "is missing in the folder");
  expect_input_error([&] { comparison.start("/etc/passwd", false); }, "is missing in the folder");
}

TEST(Comparison, SaysWhyItFails) {
  const TempFolder folder;
  folder.write("measured.csv", "label,signal\n");
  add_plan(folder, "plan");
  Comparison comparison(folder.path(), "/bin/sh");  // which finds no script 'compare'
  comparison.start("measured.csv", true);
  expect_input_error([&] { comparison.start("measured.csv", true); }, "another comparison is running");
  EXPECT_THAT(result_of(comparison)["message"].get<std::string>(), testing::HasSubstr("compare"));
  comparison.start("measured.csv", true);  // the next one
  EXPECT_TRUE(result_of(comparison).contains("message"));
}

}  // namespace
}  // namespace shelfbeam::serve
