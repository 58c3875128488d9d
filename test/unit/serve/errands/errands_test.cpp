#include "serve/errands/errands.hpp"

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "serve/errands/comparison.hpp"
#include "support/expect_input_error.hpp"
#include "support/temp_folder.hpp"

namespace shelfbeam::serve {
namespace {

namespace fs = std::filesystem;

using test::expect_input_error;
using test::TempFolder;

void add_plan(const TempFolder& folder, const std::string& name) {
  folder.write(name + "/placement.json", "{}");
  folder.write(name + "/signal.h5", "");
}

TEST(ComparisonCommand, NeedsAPlanAndAFileInTheFolder) {
  const TempFolder folder;
  folder.write("inner/measured.csv", "label,signal\n");
  folder.write("secret.csv", "label,signal\n");
  const fs::path inner = folder / "inner";
  const auto command = [&](const char* file) { return comparison_command(inner, file, false); };
  expect_input_error([&] { command("measured.csv"); }, "has no plan; run 'shelfbeam plan");
  // A plan behind links is none.
  add_plan(folder, "outer");
  fs::create_directory_symlink("../outer", inner / "linked");
  fs::create_directory(inner / "plan");
  fs::create_symlink("../../outer/signal.h5", inner / "plan" / "signal.h5");
  folder.write("inner/plan/placement.json", "{}");
  expect_input_error([&] { command("measured.csv"); }, "has no plan");
  add_plan(folder, "inner/real");
  expect_input_error([&] { command("../secret.csv"); }, "is missing in the folder");
  expect_input_error([&] { command("/etc/passwd"); }, "is missing in the folder");
  const ComparisonCommand known = command("measured.csv");
  EXPECT_EQ(known.names, (Json{{"plan", "real"}, {"output", "comparison"}}));
  EXPECT_THAT(known.words, testing::Contains("--placement"));
  fs::create_directory(inner / "comparison");
  EXPECT_EQ(comparison_command(inner, "measured.csv", true).names["output"], "comparison-2");
  EXPECT_THAT(comparison_command(inner, "measured.csv", true).words,
              testing::Not(testing::Contains("--placement")));
}

class ErrandsOfAProject : public testing::Test {
 protected:
  ErrandsOfAProject() { folder_.write("measured.csv", "label,signal\n"); }

  static LateReply reply_of(Errands& errands) {
    for (int k = 0; k < 2000; ++k) {
      std::vector<LateReply> replies = errands.poll();
      if (!replies.empty()) return replies.front();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return {};
  }
  static Request request(const char* verb, int id) {
    return {7, {{"id", id}, {"do", verb}, {"file", "measured.csv"}, {"of_pairs", true}}};
  }

  TempFolder folder_;
  PlanRuns plans_{folder_.path(), "/bin/false"};
};

TEST_F(ErrandsOfAProject, SayWhyTheyFail) {
  add_plan(folder_, "plan");
  Errands errands(folder_.path(), "/bin/sh");  // which finds no script 'compare'
  EXPECT_TRUE(errands.begin(request("compare", 1), plans_));
  expect_input_error([&] { errands.begin(request("compare", 2), plans_); }, "is running already");
  const LateReply first = reply_of(errands);
  EXPECT_EQ(first.tab, 7U);
  EXPECT_EQ(first.message["id"], 1);
  EXPECT_THAT(first.message["error"]["message"].get<std::string>(), testing::HasSubstr("compare"));
  EXPECT_TRUE(errands.begin(request("compare", 3), plans_)) << "the next one";
  EXPECT_EQ(reply_of(errands).message["id"], 3);
}

TEST_F(ErrandsOfAProject, LeaveOtherRequestsAlone) {
  Errands errands(folder_.path(), "/bin/false");
  EXPECT_FALSE(errands.begin(request("details", 1), plans_));
  EXPECT_TRUE(errands.poll().empty());
  expect_input_error(
      [&] { errands.begin({7, {{"id", 1}, {"do", "difference"}, {"before", 1U}, {"after", 2U}}}, plans_); },
      "plan");
}

TEST_F(ErrandsOfAProject, LeaveNoArchive) {
  folder_.write(".shelfbeam/project.zip.a1B2c3", "of a program that was killed");
  {
    const Errands errands(folder_.path(), "/bin/false");
    EXPECT_FALSE(fs::exists(folder_ / ".shelfbeam" / "project.zip.a1B2c3"));
    EXPECT_FALSE(errands.document("archive"));
    folder_.write(".shelfbeam/project.zip", "PK");
    const auto archive = errands.document("archive");
    ASSERT_TRUE(archive);
    EXPECT_EQ(archive->type, "application/zip");
    EXPECT_EQ(*archive->bytes, "PK");
  }
  EXPECT_FALSE(fs::exists(folder_ / ".shelfbeam" / "project.zip"));
}

}  // namespace
}  // namespace shelfbeam::serve
