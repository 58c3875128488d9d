#include "shelfbeam/base/text.hpp"

#include "app/text/progress_line.hpp"
#include "app/text/width.hpp"
#include "support/testing.hpp"

namespace shelfbeam::app {
namespace {

using jobs::Progress;
using jobs::ProgressStages;
using jobs::RemainingTime;

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

TEST(Width, CountsColumnsNotBytes) {
  EXPECT_EQ(width_of(""), 0u);
  EXPECT_EQ(width_of("Größe"), 5u);
  EXPECT_EQ(width_of("棚板"), 4u);
  EXPECT_EQ(width_of("e\u0301"), 1u);
  EXPECT_EQ(width_of("\xff\x1b"), 2u);
}

TEST(Width, TextsAreCutBetweenCharacters) {
  EXPECT_EQ(fitted("Größe", 5), "Größe");
  EXPECT_EQ(fitted("Größenordnung", 9), "Größen...");
  EXPECT_EQ(fitted("Größe", 3), "Grö");
  EXPECT_EQ(fitted("棚板棚板棚板", 9), "棚板棚...");
  EXPECT_EQ(fitted("棚板", 3), "棚");
  EXPECT_EQ(fitted("abc", 0), "");
  EXPECT_EQ(fitted("a\x1b[2Jb\xc3", 9), "a?[2Jb?");  // no escape code reaches the terminal
}

TEST(ProgressLine, FitsEveryWidth) {
  const std::string long_detail(300, 'x');
  const std::vector<Progress> states{
      {Task::simulating, 0.4, 70, 100, "2.31 million rays/s, error 3.2 %"},
      {Task::sensitivity, 0.999, 5000, 4800, "geprüfter Stahl, weiß lackiert"},
      {Task::verifying, 0, 0, -1, "round 12, 40000 labels, 1024 batches"},
      {Task::proving, -1, 7200, -1, long_detail},
      {Task::placing, -1, 12, -1, "5 units, at least 4; tree search 棚板棚板棚板"},
  };
  for (const Progress& state : states) {
    for (std::size_t width = 1; width <= 200; ++width) {
      const std::string line = progress_line(state, width);
      EXPECT_LE(width_of(line), width) << line;
      EXPECT_TRUE(is_utf8(line)) << line;
      if (width < 40) continue;
      EXPECT_THAT(line, StartsWith(std::string(to_text(state.task))));
      if (state.fraction >= 0) {
        EXPECT_THAT(line, HasSubstr(" %")) << width;
      } else {
        EXPECT_THAT(line, HasSubstr(" " + duration_text(state.seconds))) << width;
      }
      if (state.seconds_left >= 0) {
        EXPECT_THAT(line, HasSubstr(duration_text(state.seconds_left) + " left"));
      }
    }
  }
}

// The detail goes first, then the bar, then letters of the task.
TEST(ProgressLine, KeepsTheMostImportantParts) {
  const Progress state{Task::simulating, 0.4, 70, 100, "2.31 million rays/s, error 3.2 %"};
  EXPECT_EQ(
      progress_line(state, 95),
      "simulating [############..................]  40 %  2 min left  2.31 million rays/s, error 3.2 %");
  EXPECT_EQ(progress_line(state, 94),
            "simulating [############..................]  40 %  2 min left  2.31 million rays/s");
  EXPECT_EQ(progress_line(state, 75),
            "simulating [############..................]  40 %  2 min left  2.31 mill...");
  EXPECT_EQ(progress_line(state, 65), "simulating [############..................]  40 %  2 min left");
  EXPECT_EQ(progress_line(state, 40), "simulating [###.....]  40 %  2 min left");
  EXPECT_EQ(progress_line(state, 30), "simulating  40 %  2 min left");
  EXPECT_EQ(progress_line(state, 24), "simula  40 %  2 min left");
  EXPECT_EQ(progress_line({Task::simulating, 0.999, 70, 0.4, ""}, 30), "simulating  99 %  1 s left");
  EXPECT_EQ(progress_line({Task::simulating, 1, 70, 0, ""}, 30), "simulating 100 %");
}

TEST(Duration, IsInHumanUnits) {
  const auto texts = [](std::initializer_list<double> seconds) {
    std::vector<std::string> result;
    for (const double one : seconds) result.push_back(duration_text(one));
    return result;
  };
  EXPECT_EQ(texts({0, 0.2, 14.2, 15.1, 41, 55, 55.1, 61, 170, 3560}),
            (std::vector<std::string>{"0 s", "1 s", "15 s", "20 s", "45 s", "55 s", "1 min", "1 min", "3 min",
                                      "59 min"}));
  EXPECT_EQ(texts({3590, 4800, 7200, 35000, 86400}),
            (std::vector<std::string>{"1 h", "1 h 20 min", "2 h", "9 h 45 min", "24 h"}));
}

TEST(RemainingTime, IsSmoothAndRight) {
  RemainingTime steady;
  EXPECT_LT(steady.update(0, 100), 0);
  EXPECT_LT(steady.update(0.005, 100.5), 0);
  for (int tenth = 20; tenth < 1000; ++tenth) {
    const double passed = tenth / 10.0;
    EXPECT_NEAR(steady.update(passed / 100, 100 + passed), 100 - passed, 1e-6);
  }

  // Batches of unequal length: the prediction follows, but does not jump by more than a tenth in a tenth of a
  // second.
  RemainingTime uneven;
  double before = -1;
  for (int tenth = 0; tenth < 1000; ++tenth) {
    const double now = tenth / 10.0;
    const double left = uneven.update(std::floor(now / 7) * 7 / 100, now);
    if (before > 10) {
      EXPECT_NEAR(left, before, 0.1 * before) << now;
    }
    before = left;
  }
  EXPECT_LT(before, 10);

  // A new simulation begins at 0.
  RemainingTime twice;
  for (int tenth = 0; tenth <= 100; ++tenth) twice.update(tenth / 100.0, tenth / 10.0);
  EXPECT_LT(twice.update(0, 10.1), 0);
}

TEST(ProgressStages, StepsBelongToTheirStage) {
  ProgressStages stages;
  double now = 0;
  const auto shown = [&](Task task, double fraction, std::string_view detail) {
    const Progress progress = stages.update(task, fraction, detail, ++now);
    return progress_line({progress.task, progress.fraction, progress.seconds, -1, progress.detail}, 100);
  };
  EXPECT_THAT(shown(Task::preparing, 0.5, ""), StartsWith("preparing ["));
  EXPECT_THAT(shown(Task::simulating, 0.4, "fast"), EndsWith(" 40 %  fast"));
  EXPECT_EQ(shown(Task::placing, -1, "4 units"), "placing 0 s  4 units");
  EXPECT_EQ(shown(Task::verifying, -1, "round 1"), "verifying 0 s  round 1");
  EXPECT_THAT(shown(Task::preparing, 0.1, ""), StartsWith("verifying ["));
  const std::string step = shown(Task::simulating, 0.7, "not of interest");
  EXPECT_THAT(step, StartsWith("verifying ["));
  EXPECT_THAT(step, EndsWith(" 70 %  round 1"));
  EXPECT_EQ(shown(Task::proving, -1, "round 2"), "proving 0 s  round 2");
  EXPECT_EQ(shown(Task::placing, -1, "3 units"), "proving 1 s  round 2");
  // The stage's own share comes before that of its steps.
  EXPECT_THAT(shown(Task::sensitivity, 0.25, "floor"), EndsWith(" 25 %  floor"));
  EXPECT_THAT(shown(Task::simulating, 0.9, ""), EndsWith(" 25 %  floor"));
}

}  // namespace
}  // namespace shelfbeam::app
