#include "shelfbeam/placement/problem/placement_problem.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "support/expect_input_error.hpp"
#include "unit/placement/random_table.hpp"

namespace shelfbeam {
namespace {

using Values = std::vector<double>;
using test::alone;
using test::coop;

// Two labels (link costs 2 and 3, signal costs 5 and 7), three units.
SignalTable two_labels() {
  SignalTable table = test::make_table({{0.5, 1.0, 0.0}, {4.0, 0.25, 0.8}}, 3);
  table.labels[0].link_cost = 2, table.labels[1].link_cost = 3;
  table.labels[0].signal_cost = 5, table.labels[1].signal_cost = 7;
  return table;
}

Values coefficients(CommunicationModel model, Objective objective, double share = 1) {
  return objective_coefficients(two_labels(), {model, objective, Combination::lexicographic, share});
}

TEST(PlacementInstance, CoefficientsAreThoseOfTheFormulas) {
  EXPECT_EQ(coefficients(coop, Objective::count), (Values{0, 0, 0}));
  EXPECT_EQ(coefficients(coop, Objective::links), (Values{5, 5, 5}));   // (3.13): t_ij = T_j for every label
  EXPECT_EQ(coefficients(alone, Objective::links), (Values{3, 2, 0}));  // (3.3): l_ij
  EXPECT_EQ(coefficients(coop, Objective::effective_links), (Values{3, 2, 0}));
  EXPECT_EQ(coefficients(coop, Objective::effective_links, 0.5), (Values{5, 2, 3}));
  EXPECT_EQ(coefficients(alone, Objective::effective_links, 4), (Values{3, 0, 0}));
  // (3.10): the unclipped signal, 4 and not 1
  EXPECT_EQ(coefficients(coop, Objective::signal), (Values{0.5 * 5 + 4 * 7, 1 * 5 + 0.25 * 7, 0.8 * 7}));
}

TEST(PlacementInstance, LinksWithoutCostsCountOne) {
  SignalTable table = two_labels();
  EXPECT_FALSE(label_costs(table, Objective::links).unit);
  for (auto& label : table.labels) label.link_cost = 0;
  EXPECT_TRUE(label_costs(table, Objective::links).unit);
  EXPECT_TRUE(label_costs(table, Objective::effective_links).unit);
  EXPECT_FALSE(label_costs(table, Objective::signal).unit);
  EXPECT_FALSE(label_costs(table, Objective::count).unit);
  EXPECT_EQ(objective_coefficients(table, {alone, Objective::links}), (Values{1, 1, 0}));
  table.labels[1].link_cost = 0.5;  // one given cost suffices to keep the others as they are
  EXPECT_EQ(objective_coefficients(table, {alone, Objective::links}), (Values{0.5, 0, 0}));
}

TEST(PlacementInstance, ReachAloneHasItsOwnRequirement) {
  SignalTable table = two_labels();
  table.labels[0].single_requirement = 0.5;
  EXPECT_EQ(objective_coefficients(table, {alone, Objective::links}), (Values{5, 2, 0}));
  EXPECT_EQ(objective_coefficients(table, {coop, Objective::effective_links}), (Values{3, 2, 0}));
}

TEST(PlacementInstance, RejectsLabelsWithoutRequirement) {
  for (const double wrong :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    SignalTable table = two_labels();
    table.labels[1].requirement = wrong;
    test::expect_input_error([&] { check_problem(table, {coop}); }, "label L1: ");
    EXPECT_NO_THROW(check_problem(table, {alone}));
    table.labels[1].single_requirement = wrong;
    test::expect_input_error([&] { check_problem(table, {alone}); }, "label L1: ");
  }
}

TEST(PlacementInstance, RejectsInvalidShares) {
  for (const double wrong : {0.0, -0.5, std::numeric_limits<double>::quiet_NaN()}) {
    const PlacementProblem problem{coop, Objective::effective_links, Combination::lexicographic, wrong};
    test::expect_input_error([&] { check_problem(two_labels(), problem); }, "share of effective links");
  }
}

TEST(PlacementProblem, IsACoverIfEachSignalReachesItsLabel) {
  SignalTable table = test::make_table({{1, 0, 2}, {0, 1, 1 - 1e-10}}, 3);
  EXPECT_TRUE(is_cover_of_sums(table, {}));
  EXPECT_TRUE(is_cover_of_sums(table, {.redundant = true}));
  EXPECT_FALSE(is_cover_of_sums(table, {.model = test::alone})) << "it is one already";
  EXPECT_FALSE(is_cover_of_sums(table, {.objective = Objective::links})) << "the costs of links differ";
  table.labels[1].requirement = 1.5;
  EXPECT_FALSE(is_cover_of_sums(table, {}));
}

}  // namespace
}  // namespace shelfbeam
