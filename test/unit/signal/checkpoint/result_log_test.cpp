#include "shelfbeam/signal/checkpoint/result_log.hpp"

#include "support/testing.hpp"
#include "unit/signal/checkpoint/identity.hpp"

namespace shelfbeam::test {
namespace {

TEST(ResultLog, KeepsResultsForTheNextRun) {
  const TempFolder folder;
  const auto path = folder / "results";
  {
    ResultLog log(path, identity, false, 0);
    EXPECT_FALSE(log.find(7));
    log.add(7, "seven");
    log.add(8, "");
  }
  {
    ResultLog log(path, identity, true, 1000);
    EXPECT_EQ(log.find(7), "seven");
    EXPECT_EQ(log.find(8), "");
    EXPECT_FALSE(log.find(9));
    log.add(9, "nine");
  }
  EXPECT_EQ(ResultLog(path, identity, true, 0).find(7), "seven");
  EXPECT_EQ(ResultLog(path, identity, true, 0).find(9), "nine");
  EXPECT_FALSE(ResultLog(path, identity, false, 0).find(7)) << "without resuming";
}

TEST(ResultLog, DropsATruncatedRecord) {
  const TempFolder folder;
  const auto path = folder / "results";
  {
    ResultLog log(path, identity, false, 0);
    log.add(7, "seven");
    log.add(8, "eight");
  }
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 3);
  const ResultLog log(path, identity, true, 0);
  EXPECT_EQ(log.find(7), "seven");
  EXPECT_FALSE(log.find(8));
}

TEST(ResultLog, RefusesOtherRunsAndOtherFiles) {
  const TempFolder folder;
  const auto path = folder / "results";
  {
    ResultLog(path, identity, false, 0).add(7, "seven");
  }
  expect_input_error([&] { ResultLog(path, {{"store hash", "abc"}, {"seed", "2"}}, true, 0); },
                     std::string_view("its seed is '1' instead of '2'"));
  {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(-2, std::ios::end);
    file.put('x');
  }
  expect_input_error([&] { ResultLog(path, identity, true, 0); }, std::string_view("is corrupt at byte"));
  folder.write("letter", "Dear Sir");
  expect_input_error([&] { ResultLog(folder / "letter", identity, false, 0); },
                     std::string_view("is not a checkpoint"));
}

TEST(ResultLog, KeepsNothingWithoutAPath) {
  ResultLog log({}, identity, false, 0);
  log.add(7, "seven");
  log.flush();
  EXPECT_FALSE(log.find(7));
}

}  // namespace
}  // namespace shelfbeam::test
