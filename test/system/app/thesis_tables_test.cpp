#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "system/app/program.hpp"

namespace shelfbeam {
namespace {

// Slow, because it simulates the thesis environment.
TEST(ThesisTablesSlow, AreComparedWithThePaper) {
  const test::TempFolder folder;
  const auto run = [&](const std::string& limit) {
    const test::Outcome outcome = test::run(
        {"/usr/bin/env", std::string("SHELFBEAM=") + SHELFBEAM_BINARY, "TIME_LIMIT=" + limit,
         std::string(SHELFBEAM_SOURCE_DIR) + "/scripts/thesis-tables", "--quick", folder.path().string()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.out;
  };
  const std::string out = run("5");
  const test::Json best = test::Json::parse(read_file(folder / "5000-non-cooperative-count-auto.json"));
  const test::Json greedy = test::Json::parse(read_file(folder / "5000-non-cooperative-count-greedy.json"));
  EXPECT_EQ(best["status"], "optimal");
  // Our number and the paper's in the first columns of the first two tables.
  const auto first_column = [](const test::Json& answer, const std::string& paper) {
    return fmt::format(
        "    5000 | {:<14} {} ",
        fmt::format("{} {:.0f}%", answer["count"].get<int>(), 100 * answer["redundant_share"].get<double>()),
        paper);
  };
  const std::size_t optimal = out.find("Table 3.1"), heuristic = out.find("Table 3.2");
  EXPECT_NE(out.substr(optimal, heuristic - optimal).find(first_column(best, "8 54%")), std::string::npos)
      << out;
  EXPECT_NE(out.substr(heuristic).find(first_column(greedy, "10 77%")), std::string::npos) << out;

  // With another time limit, final results are reused and stopped ones are not.
  const auto changed = [&](const std::string& problem) {
    return std::filesystem::exists(folder / ("5000-" + problem + "-6s.json"));
  };
  std::string stopped = read_file(folder / "5000-cooperative-count-auto-5s.json");
  stopped.replace(stopped.find("optimal"), 7, "stopped");
  folder.write("5000-cooperative-count-auto-5s.json", stopped);
  run("6");
  EXPECT_FALSE(changed("non-cooperative-count-auto"));
  EXPECT_FALSE(changed("non-cooperative-count-greedy"));
  EXPECT_TRUE(changed("cooperative-count-auto"));
}

}  // namespace
}  // namespace shelfbeam
