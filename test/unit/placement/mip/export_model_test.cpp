#include "shelfbeam/placement/mip/export_model.hpp"

#include <gtest/gtest.h>

#include "shelfbeam/milp/model.hpp"
#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/answer/placement.hpp"

#include "support/expect_input_error.hpp"
#include "support/temp_folder.hpp"
#include "unit/placement/random_table.hpp"

namespace shelfbeam {
namespace {

TEST(PlacementExport, DividesRowsByTheirRequirementAndClipsNothing) {
  SignalTable table = test::make_table({{4.0, 0.5, 0.0}, {0.0, 2.0, 3.0}}, 3);
  table.labels[1].requirement = 2;
  table.transceivers[0].cost = 7;
  table.transceivers[2].installed = true;
  milp::Model model = placement_model(table, {});
  ASSERT_EQ(model.columns.size(), 3U);
  EXPECT_EQ(model.columns[0].cost, 1);
  EXPECT_EQ(model.columns[0].name, "T0");
  EXPECT_EQ(model.columns[0].lower, 0);
  EXPECT_EQ(model.columns[2].lower, 1);
  EXPECT_EQ(model.rows[0].name, "L0");
  EXPECT_EQ(model.rows[0].lower, 1 - 1e-9);
  EXPECT_EQ(model.rows[0].entries[0].value, 4);
  EXPECT_EQ(model.rows[1].entries[1].value, 1.5);

  model =
      placement_model(table, {CommunicationModel::non_cooperative, Objective::links, Combination::weighted});
  EXPECT_EQ(model.columns[0].cost, 8);
  EXPECT_EQ(model.columns[1].cost, 2);
  ASSERT_EQ(model.rows[0].entries.size(), 1U);
  EXPECT_EQ(model.rows[0].entries[0].value, 1);
  EXPECT_EQ(model.rows[0].lower, 1);
}

TEST(PlacementExport, HasRowsForMountingPointsAndConflicts) {
  SignalTable table = test::make_table({{4.0, 0.5, 0.0, 1.0}}, 4);
  table.mounts = {{0, 2}};
  table.conflicts = {{1, 3}};
  for (const auto model : {CommunicationModel::cooperative, CommunicationModel::non_cooperative}) {
    const milp::Model built = placement_model(table, {model});
    ASSERT_EQ(built.rows.size(), 3U);
    EXPECT_EQ(built.rows[1].name, "mount_T0");
    EXPECT_EQ(built.rows[2].name, "apart_T1_T3");
    for (const std::uint32_t first : {0U, 1U}) {
      const milp::Row& row = built.rows[1 + first];
      EXPECT_EQ(row.lower, -milp::infinity);
      EXPECT_EQ(row.upper, 1);
      ASSERT_EQ(row.entries.size(), 2U);
      EXPECT_EQ(row.entries[0].column, first);
      EXPECT_EQ(row.entries[1].column, first + 2);
      EXPECT_EQ(row.entries[1].value, 1);
    }
  }
}

TEST(PlacementExport, LetsEveryUnitFail) {
  const SignalTable table = test::make_table({{4.0, 0.5, 0.0, 1.0}}, 4);
  const milp::Model of_single =
      placement_model(table, {.model = CommunicationModel::non_cooperative, .redundant = true});
  ASSERT_EQ(of_single.rows.size(), 1U);
  EXPECT_EQ(of_single.rows[0].lower, 2);
  const milp::Model model = placement_model(table, {.redundant = true});
  ASSERT_EQ(model.rows.size(), 4U);
  EXPECT_EQ(model.rows[1].name, "L0_without_T0");
  EXPECT_EQ(model.rows[1].lower, 1 - 1e-9);
  ASSERT_EQ(model.rows[1].entries.size(), 2U);
  EXPECT_EQ(model.rows[1].entries[0].value, 0.5);
  EXPECT_EQ(model.rows[3].name, "L0_without_T3");
}

TEST(PlacementExport, RefusesFailuresOfALargeMatrix) {
  const SignalTable table =
      test::make_table(std::vector<std::vector<double>>(6, std::vector<double>(2000, 1.0)), 2000);
  test::expect_input_error([&] { placement_model(table, {.redundant = true}); }, "23988000 entries");
}

// Both files, read by every solver, have the optimum that `place` proves; both within a gap of 1e-6.
TEST(PlacementExportSlow, HasTheOptimumOfThePlacement) {
  const test::TempFolder folder;
  test::RandomTables plain(51, {.labels = 6, .transceivers = 8, .borderline = false});
  test::RandomTables with_options(52, {.labels = 6, .transceivers = 8, .borderline = false, .mounts = true});
  test::RandomTables beyond(
      53, {.labels = 4, .transceivers = 8, .borderline = false, .conflicts = true, .redundant = true});
  int feasible = 0, control = 0, mount_control = 0, beyond_control = 0;
  for (int k = 0; k < 450; ++k) {
    test::RandomTables& tables = k % 3 == 0 ? plain : k % 3 == 1 ? with_options : beyond;
    const SignalTable table = tables.next();
    PlacementProblem problem = tables.next_problem();
    if (problem.combination == Combination::lexicographic) problem.objective = Objective::count;
    const Placement found = place(table, problem, {});
    const milp::Model model = placement_model(table, problem);
    milp::write_mps(model, folder / "model.mps");
    milp::write_lp(model, folder / "model.lp");
    for (const char* file : {"model.mps", "model.lp"}) {
      for (const milp::Backend& backend : milp::backends()) {
        SCOPED_TRACE(testing::Message() << k << file << backend.name);
        const milp::Result result = backend.solve(backend.read(folder / file), {}, {});
        if (found.status == Status::infeasible) {
          EXPECT_EQ(result.termination, milp::Termination::infeasible);
          continue;
        }
        ++feasible;
        EXPECT_EQ(result.termination, milp::Termination::optimal);
        EXPECT_NEAR(result.primal_bound, found.objective_value, 2e-6 * found.objective_value);
      }
    }
    // Negative controls: some optima differ without the first row, without the rows of failures and
    // conflicts, and without those of the mounting points.
    const auto is_less = [&](const milp::Model& relaxed) {
      const milp::Result result = milp::backends().front().solve(relaxed, {}, {});
      return result.primal_bound < found.objective_value * (1 - 1e-5);
    };
    milp::Model without_first = model, without_points = model;
    if (!model.rows.empty()) without_first.rows.erase(without_first.rows.begin());
    without_points.rows.resize(table.rows());
    SignalTable together = table;
    together.conflicts.clear();
    mount_control += !table.mounts.empty() && is_less(without_points);
    if (found.status == Status::infeasible) continue;
    control += is_less(without_first);
    beyond_control += k % 3 == 2 && is_less(model_without_failures({together, problem}));
  }
  EXPECT_GT(feasible, 200);
  EXPECT_GT(control, 10);
  EXPECT_GT(mount_control, 10);
  EXPECT_GT(beyond_control, 10);
}

}  // namespace
}  // namespace shelfbeam
