#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "program.hpp"

namespace shelfbeam {
namespace {

// Slow, because it simulates the thesis environment.
TEST(ThesisTablesSlow, StandBesideThePapersNumbers) {
  const test::TempFolder folder;
  const test::Outcome outcome =
      test::run({"/usr/bin/env", std::string("SHELFBEAM=") + SHELFBEAM_BINARY, "TIME_LIMIT=5",
                 SHELFBEAM_SOURCE_DIR "/scripts/thesis-tables", "--quick", folder.path().string()});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* title : {"Table 3.1", "Table 3.2", "Table 3.3", "8 54%", "10 77%"})
    EXPECT_NE(outcome.out.find(title), std::string::npos) << outcome.out;
  const test::Json best = test::Json::parse(read_file(folder / "5000-non-cooperative-count-auto.json"));
  EXPECT_EQ(best["status"], "optimal");
  EXPECT_NE(outcome.out.find("5000 | " + std::to_string(best["count"].get<int>()) + " "), std::string::npos)
      << outcome.out;
}

}  // namespace
}  // namespace shelfbeam
