#include "jobs/event.hpp"

#include <thread>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/memory.hpp"

#include "support/testing.hpp"

namespace shelfbeam::jobs {
namespace {

TEST(JobEvents, EndsAreReadBack) {
  const PlanSummary summary{{"4 transceivers\nreach \"all\"",
                             "Verified.",
                             686,
                             4,
                             std::nullopt,
                             480.5,
                             470.25,
                             "EUR",
                             {{FindingCode::labels_flooded, "", {3.0, "L1"}, "w"}}},
                            stopped_early};
  const std::string line = line_of(JobResult{summary, true});
  EXPECT_EQ(line.find('\n'), line.size() - 1) << "one line";
  auto end = read_end(line);
  ASSERT_TRUE(end);
  EXPECT_EQ(exit_code_of(*end), stopped_early);
  const auto& result = std::get<JobResult>(*end);
  EXPECT_TRUE(result.is_complete);
  EXPECT_EQ(result.summary.units, 4U);
  EXPECT_FALSE(result.summary.lower_bound);
  EXPECT_EQ(result.summary.price_lower_bound, 470.25);
  EXPECT_EQ(line_of(*end), line);
  end = read_end(line_of(JobError{out_of_memory, "\xff", true, false}));
  ASSERT_TRUE(end);
  EXPECT_EQ(exit_code_of(*end), out_of_memory);
  EXPECT_TRUE(std::get<JobError>(*end).is_of_checkpoint);
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
  std::vector<std::string> selected = {"before"};

  void report(Task task, double fraction, std::string_view detail) override {
    tasks.push_back(std::string(to_text(task)) + (fraction < 0 ? "" : " with share") + std::string(detail));
  }
  void bounds(double best, double) override { incumbent = best; }
  void selection(const std::vector<std::string>& ids) override { selected = ids; }
};

// The event lines of a run, and their meaning for a listener.
struct Told {
  std::vector<std::string> lines;
  EventProgress progress{[this](std::string_view line) { lines.emplace_back(line); }};

  // What is heard when the next line may be written.
  Heard next(Task task, const std::string& detail = "") {
    const std::size_t before = lines.size();
    for (int k = 0; lines.size() == before && k < 2000; ++k) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      progress.report(task, -1, detail);
    }
    if (lines.size() == before) throw std::runtime_error("no line has been written");
    Heard heard;
    EXPECT_TRUE(pass_on(lines.back(), heard));
    return heard;
  }
};

TEST(JobEvents, ProgressIsPassedOnAtMostFourTimesASecond) {
  Told run;
  const auto begin = std::chrono::steady_clock::now();
  for (int k = 0; k < 100; ++k) run.progress.report(Task::simulating, 0.01 * k, "");
  ASSERT_EQ(run.lines.size(), 1U);
  Heard heard;
  EXPECT_TRUE(pass_on(run.lines.front(), heard));
  EXPECT_EQ(heard.tasks, std::vector<std::string>{"simulating with share"});
  EXPECT_EQ(run.next(Task::proving, ": x").tasks, std::vector<std::string>{"proving: x"});
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(250));
  EXPECT_FALSE(pass_on(line_of(JobResult{PlanSummary{}, true}), heard));
}

// A search that is a step of a stage has bounds of its own.
TEST(JobEvents, BoundsAreThoseOfTheTask) {
  Told run;
  run.progress.bounds(5, 3);
  EXPECT_EQ(run.next(Task::placing).incumbent, 5);
  EXPECT_EQ(run.next(Task::placing).incumbent, 5);
  EXPECT_EQ(run.next(Task::verifying).incumbent, 0);
  run.progress.bounds(7, 6);
  EXPECT_EQ(run.next(Task::placing).incumbent, 0);
  EXPECT_EQ(run.lines.size(), 4U);
}

// They may be long, and are written when they change; those of steps are not of the task.
TEST(JobEvents, SelectionsAreWrittenOnce) {
  using Ids = std::vector<std::string>;
  Told run;
  for (const auto& [task, ids, heard] : {std::tuple(Task::placing, Ids{"a", "b"}, Ids{"a", "b"}),
                                         {Task::placing, {"a", "b"}, {"before"}},
                                         {Task::placing, {"a"}, {"a"}},
                                         {Task::verifying, {}, {}},
                                         {Task::placing, {"c"}, {"before"}}}) {
    run.progress.selection(ids);
    EXPECT_EQ(run.next(task).selected, heard);
  }
  PlanSummary summary;
  summary.selected = {"a"};
  const auto end = read_end(line_of(JobResult{summary, true}));
  EXPECT_EQ(std::get<JobResult>(*end).summary.selected, Ids{"a"});
}

}  // namespace
}  // namespace shelfbeam::jobs
