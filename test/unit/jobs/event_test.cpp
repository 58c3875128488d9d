#include "jobs/event.hpp"

#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/memory.hpp"

namespace shelfbeam::jobs {
namespace {

TEST(JobEvents, EndsAreReadBack) {
  const PlanSummary summary{{"4 transceivers\nreach \"all\"", 686, 4, std::nullopt, 480.5, "EUR", {"w"}},
                            stopped_early};
  const std::string line = line_of(JobEnd{summary, true, {}});
  EXPECT_EQ(line.find('\n'), line.size() - 1) << "one line";
  auto end = read_end(line);
  ASSERT_TRUE(end && end->summary);
  EXPECT_TRUE(end->is_complete);
  EXPECT_EQ(end->summary->code, stopped_early);
  EXPECT_EQ(end->summary->units, 4U);
  EXPECT_FALSE(end->summary->lower_bound);
  EXPECT_EQ(line_of(*end), line);
  end = read_end(line_of(JobEnd{{}, false, JobError{out_of_memory, "\xff", true, false}}));
  ASSERT_TRUE(end && end->error);
  EXPECT_EQ(end->error->code, out_of_memory);
  EXPECT_TRUE(end->error->is_of_checkpoint);
  for (const char* other : {"", "{}", "null", "Segmentation fault", R"({"event": "progress"})"})
    EXPECT_FALSE(read_end(other)) << other;
}

TEST(JobEvents, ErrorsHaveTheirCodes) {
  EXPECT_EQ(error_of(InputError("a", "b")).code, wrong_input);
  EXPECT_EQ(error_of(MemoryError("a", "b")).code, out_of_memory);
  EXPECT_EQ(error_of(InputError("a", "b", "", Setting::memory)).code, out_of_memory);
  EXPECT_EQ(error_of(std::bad_alloc()).code, out_of_memory);
  EXPECT_EQ(error_of(std::runtime_error("a")).code, internal_error);
  EXPECT_TRUE(error_of(Interrupted("a")).is_interruption);
  EXPECT_TRUE(error_of(InputError("a", "b", "", Setting::resumption)).is_of_checkpoint);
  EXPECT_FALSE(error_of(OutputError("a", "b", "", Setting::resumption)).is_of_checkpoint);
}

class Heard : public ProgressSink {
 public:
  std::vector<std::string> tasks;
  double incumbent = 0;

  void report(std::string_view task, double fraction, std::string_view detail) override {
    tasks.push_back(std::string(task) + (fraction < 0 ? "" : " with share") + std::string(detail));
  }
  void bounds(double best, double) override { incumbent = best; }
};

TEST(JobEvents, ProgressIsPassedOnAtMostFourTimesASecond) {
  std::vector<std::string> lines;
  EventProgress progress([&](std::string_view line) { lines.emplace_back(line); });
  progress.bounds(5, 3);
  for (int k = 0; k < 100; ++k) progress.report("simulating", 0.01 * k, "");
  ASSERT_EQ(lines.size(), 1U);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  progress.report("proving", -1, ": x");
  ASSERT_EQ(lines.size(), 2U);
  Heard heard;
  for (const std::string& line : lines) EXPECT_TRUE(pass_on(line, heard)) << line;
  EXPECT_EQ(heard.tasks, (std::vector<std::string>{"simulating with share", "proving: x"}));
  EXPECT_EQ(heard.incumbent, 5);
  EXPECT_FALSE(pass_on(line_of(JobEnd{PlanSummary{}, true, {}}), heard));
}

}  // namespace
}  // namespace shelfbeam::jobs
