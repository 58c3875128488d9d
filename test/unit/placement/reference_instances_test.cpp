#include <filesystem>

#include <gtest/gtest.h>

#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

#include "unit/placement/random_table.hpp"

namespace shelfbeam {
namespace {

using test::alone;
using test::coop;

const std::filesystem::path instances = SHELFBEAM_SOURCE_DIR "/test/data/instances";

// 300 x 150; both optima are 5.
void prove_thesis_size(const milp::Backend& backend) {
  const SignalTable table = read_signal_table(instances / "thesis_s1_e0.txt.gz");
  ASSERT_EQ(table.rows(), 300U);
  ASSERT_EQ(table.columns(), 150U);
  for (const auto model : {alone, coop}) {
    const Placement found =
        place(table, {model}, {.backend = std::string(backend.name), .step_limit = 1 << 24});
    EXPECT_EQ(found.status, Status::optimal) << backend.name;
    EXPECT_EQ(found.count(), 5U) << backend.name;
    EXPECT_EQ(found.count_lower_bound, 5) << backend.name;
    EXPECT_TRUE(check_selection(table, {model}, found.selected).met());
  }
}

TEST(PlacementReference, ProvesTheThesisSize) {
  prove_thesis_size(milp::backends().front());
}

TEST(PlacementReferenceSlow, EverySolverProvesTheThesisSize) {
  for (const milp::Backend& backend : milp::backends()) prove_thesis_size(backend);
}

// 680 x 600; the non-cooperative optimum is 27, the cooperative one between 22 and 25.
TEST(PlacementReferenceSlow, SolvesTheSupermarket) {
  const SignalTable table = read_signal_table(instances / "super_s1_e0_part.txt.gz");
  const Placement proven = place(table, {alone}, {.step_limit = 1 << 20});
  EXPECT_EQ(proven.status, Status::optimal);
  EXPECT_EQ(proven.count(), 27U);

  const Placement stopped = place(table, {coop}, {.step_limit = 2000});
  EXPECT_EQ(stopped.status, Status::stopped);
  EXPECT_TRUE(check_selection(table, {coop}, stopped.selected).met());
  EXPECT_LE(stopped.count(), 26U);
  EXPECT_GE(stopped.count_lower_bound, 22);
  EXPECT_LE(stopped.count_lower_bound, 25);
}

}  // namespace
}  // namespace shelfbeam
