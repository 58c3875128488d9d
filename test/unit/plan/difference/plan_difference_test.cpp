#include "shelfbeam/plan/difference/plan_difference.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "shelfbeam/placement/problem/checker.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam {
namespace {

/// A plan for three labels and four candidates. Label i has the signal 1 from unit i, 0.1 from the others,
/// and the requirement 1.
struct Example {
  SignalMatrix matrix;
  CertifiedPlan plan;
  std::string store = R"({"transceivers": {"list": []}})";

  explicit Example(Selection selected = {0, 1, 2}) {
    for (int i = 0; i < 3; ++i) {
      matrix.labels.push_back({fmt::format("L{}", i), "standard", {1.0 * i, 0, 1}, {0, 1, 0}, 1});
      for (int j = 0; j < 4; ++j) matrix.mean.push_back(i == j ? 1.0F : 0.1F);
    }
    for (int j = 0; j < 4; ++j)
      matrix.transceivers.push_back({fmt::format("T{}", j), "ceiling", {1.0 * j, 0, 3}, {0, 0, -1}, 100});
    choose(std::move(selected));
  }
  void choose(Selection selected) {
    plan.placement.selected = std::move(selected);
    plan.placement.objective_value = static_cast<double>(plan.placement.count());
  }
  void certify(const std::vector<Verdict>& verdicts) {
    Certificate& certificate = plan.certificate.emplace();
    for (const Verdict verdict : verdicts) certificate.labels.push_back({.verdict = verdict});
  }
  ComparedPlan compared() const { return compared_plan(matrix, plan, store); }
};

PlanDifference difference(const Example& before, const Example& after) {
  return difference_of(before.compared(), after.compared());
}

std::vector<std::size_t> unit_counts(const PlanDifference& d) {
  return {d.count(UnitChange::kept), d.count(UnitChange::changed), d.count(UnitChange::added),
          d.count(UnitChange::removed)};
}

using Counts = std::vector<std::size_t>;

std::vector<std::string> ids(const PlanDifference& d, LabelChange change, const Example& before,
                             const Example& after) {
  std::vector<std::string> found;
  for (const ComparedLabel& label : d.labels)
    if (label.change() == change)
      found.push_back(label.after ? after.matrix.labels[label.after->row].id
                                  : before.matrix.labels[label.before->row].id);
  return found;
}

using Ids = std::vector<std::string>;

TEST(PlanDifference, OfAPlanAndItselfIsEmpty) {
  Example one;
  EXPECT_TRUE(difference(one, one).is_empty());
  EXPECT_EQ(difference(one, one).count(LabelChange::stays_reached), 3U);
  one.certify({Verdict::reached, Verdict::reached, Verdict::reached});
  EXPECT_TRUE(difference(one, one).is_empty());
  EXPECT_FALSE(difference(Example(), one).is_empty()) << "another certificate";
  one.plan.placement.count_lower_bound = 2;
  Example other = one;
  other.plan.placement.count_lower_bound = 3;
  EXPECT_FALSE(difference(one, other).is_empty()) << "another bound";
}

TEST(PlanDifference, SwapsGainsAndLosses) {
  const Example all, fewer({0, 3});
  const PlanDifference there = difference(all, fewer), back = difference(fewer, all);
  EXPECT_EQ(unit_counts(there), (Counts{1, 0, 1, 2}));
  EXPECT_EQ(unit_counts(back), (Counts{1, 0, 2, 1}));
  EXPECT_EQ(ids(there, LabelChange::lost, all, fewer), (Ids{"L1", "L2"}));
  EXPECT_EQ(ids(back, LabelChange::gained, fewer, all), (Ids{"L1", "L2"}));
  EXPECT_EQ(there.count(LabelChange::gained), 0U);
  EXPECT_EQ(there.count(LabelChange::stays_reached), 1U);
  EXPECT_EQ(there.figures.before.reached, 3U);
  EXPECT_EQ(there.figures.after.reached, 1U);
  EXPECT_EQ(back.figures.after.units, 3U);
  EXPECT_EQ(difference(fewer, fewer).count(LabelChange::stays_missed), 2U);
}

TEST(PlanDifference, MatchesUnitsByIdAndByPlace) {
  const Example before;
  Example renamed = before;
  renamed.matrix.transceivers[1].id = "new";
  renamed.matrix.transceivers[1].position.x += 1e-9;
  EXPECT_EQ(unit_counts(difference(before, renamed)), (Counts{3, 0, 0, 0}));
  EXPECT_TRUE(difference(before, renamed).is_empty());
  for (int kind = 0; kind < 3; ++kind) {
    Example changed = before;
    TransceiverColumn& unit = changed.matrix.transceivers[1];
    if (kind == 0) unit.position.y = 0.5;
    if (kind == 1) unit.axis = {0, 1, 0};
    if (kind == 2) unit.type = "wide";
    EXPECT_EQ(unit_counts(difference(before, changed)), (Counts{2, 1, 0, 0})) << kind;
    EXPECT_FALSE(difference(before, changed).is_empty());
    unit.id = "new";
    EXPECT_EQ(unit_counts(difference(before, changed)), (Counts{2, 0, 1, 1})) << kind;
  }
}

TEST(PlanDifference, MatchesLabelsByIdAndByPlace) {
  const Example before;
  Example after = before;
  after.matrix.labels[0].id = "renamed";
  after.matrix.labels[1].position.z = 2;
  EXPECT_EQ(difference(before, after).count(LabelChange::stays_reached), 3U);
  after.matrix.labels[1].id = "new";
  const PlanDifference there = difference(before, after);
  EXPECT_EQ(ids(there, LabelChange::added, before, after), Ids{"new"});
  EXPECT_EQ(ids(there, LabelChange::removed, before, after), Ids{"L1"});
  EXPECT_FALSE(there.is_empty());
}

// The certificate decides; without its verdict, the signal does.
TEST(PlanDifference, CountsReachedLabelsByTheCertificate) {
  const Example before;
  Example after({0, 1, 3});  // misses L2
  after.certify({Verdict::undecided, Verdict::missed, Verdict::reached});
  const PlanDifference there = difference(before, after);
  EXPECT_EQ(ids(there, LabelChange::lost, before, after), Ids{"L1"});
  EXPECT_EQ(there.figures.after.certificate, CertificateState::missed);
  EXPECT_EQ(there.figures.after.certified, 1U);
  after.certify({Verdict::undecided, Verdict::unverified, Verdict::reached});
  EXPECT_EQ(difference(before, after).figures.after.certificate, CertificateState::open);
  after.certify({Verdict::reached, Verdict::reached, Verdict::reached});
  EXPECT_EQ(difference(before, after).figures.after.certificate, CertificateState::certified);
  after.certify({Verdict::unverified, Verdict::unverified, Verdict::unverified});
  EXPECT_EQ(difference(before, after).figures.after.certificate, CertificateState::none);
}

TEST(PlanDifference, ComparesAvailabilities) {
  Example before, after;
  for (Example* one : {&before, &after}) {
    Availability& availability = one->plan.availability.emplace();
    availability.required = {0.9, 0.9, 0.9};
    availability.certified = true;
    availability.lower_bound = 2;
  }
  before.plan.availability->examined = {{3, 100, {0, 0, 20}, 20}};
  after.plan.availability->examined = {{3, 100, {0, 11, 10}, 20}};
  const PlanDifference there = difference(before, after);
  EXPECT_EQ(ids(there, LabelChange::gained, before, after), Ids{"L2"});
  EXPECT_EQ(ids(there, LabelChange::lost, before, after), Ids{"L1"});
  EXPECT_DOUBLE_EQ(there.figures.before.worst_availability.value(), 0.8);
  EXPECT_DOUBLE_EQ(there.labels[1].after->availability.value(), 0.89);
  EXPECT_EQ(there.figures.after.certificate, CertificateState::certified);
  EXPECT_EQ(there.figures.after.bounds.certified, 2);
  EXPECT_TRUE(there.question.empty());
  after.plan.availability->goal = {AvailabilityRule::misses, 1};
  EXPECT_EQ(difference(before, after).question,
            (std::vector{QuestionKey::availability_rule, QuestionKey::availability_goal}));
  // A shop that does not change has none.
  EXPECT_FALSE(difference(Example(), after).figures.before.worst_availability);
}

TEST(PlanDifference, FindsEveryChangeOfTheQuestion) {
  const auto changed = [](const auto& edit) {
    Example after;
    edit(after.plan);
    return difference(Example(), after).question;
  };
  using Keys = std::vector<QuestionKey>;
  const auto problem = [&](const auto& edit) {
    return changed([&](CertifiedPlan& plan) { edit(plan.placement.problem); });
  };
  EXPECT_EQ(problem([](auto& p) { p.model = CommunicationModel::non_cooperative; }),
            Keys{QuestionKey::model});
  EXPECT_EQ(problem([](auto& p) { p.redundant = true; }), Keys{QuestionKey::survives_failure});
  EXPECT_EQ(problem([](auto& p) { p.objective = Objective::links; }), Keys{QuestionKey::objective});
  EXPECT_EQ(problem([](auto& p) { p.combination = Combination::spend; }), Keys{QuestionKey::combination});
  EXPECT_EQ(problem([](auto& p) { p.share = 0.5; }), Keys{QuestionKey::share});
  EXPECT_EQ(changed([](auto& plan) { plan.placement.min_spacing = 2; }), Keys{QuestionKey::min_spacing});
  EXPECT_EQ(changed([](auto& plan) { plan.placement.forbidden_pairs = 3; }),
            Keys{QuestionKey::forbidden_pairs});
  EXPECT_EQ(changed([](auto& plan) { plan.placement.partial = {ReachGoal::at_most, 3, 2, 2}; }),
            Keys{QuestionKey::partial});
  Example two_units, three_units;
  two_units.plan.placement.partial = {ReachGoal::at_most, 2, 1, 1};
  three_units.plan.placement.partial = {ReachGoal::at_most, 3, 1, 1};
  EXPECT_EQ(difference(two_units, three_units).question, Keys{QuestionKey::partial});
  three_units.plan.placement.partial = {ReachGoal::at_most, 2, 3, 3};
  EXPECT_TRUE(difference(two_units, three_units).question.empty()) << "only the answers differ";
  Example one, two;
  one.certify({Verdict::reached, Verdict::reached, Verdict::reached});
  two.certify({Verdict::reached, Verdict::reached, Verdict::reached});
  two.plan.certificate->confidence = 0.95;
  EXPECT_EQ(difference(one, two).question, Keys{QuestionKey::confidence});
}

TEST(PlanDifference, NamesTheWeakestLabels) {
  Example one;
  one.matrix.labels[1].requirement = 1.1;
  one.matrix.labels[2].requirement = 0;  // no requirement, so no margin
  EXPECT_EQ(difference(one, one).figures.after.weakest, (std::vector<LabelId>{1, 0, 2}));
  one.choose({});
  EXPECT_TRUE(difference(one, one).figures.after.weakest.empty()) << "without units";
}

// Signals are those of the checker of placements, to the bit.
TEST(PlanDifference, TakesSignalsAsTheCheckerDoes) {
  for (const bool redundant : {false, true})
    for (const auto model : {CommunicationModel::cooperative, CommunicationModel::non_cooperative}) {
      Example one({0, 2, 3});
      one.plan.placement.problem.model = model;
      one.plan.placement.problem.redundant = redundant;
      const Check check = check_selection(make_signal_table(one.matrix), one.plan.placement.problem,
                                          one.plan.placement.selected);
      EXPECT_EQ(one.compared().signals, check.signal);
    }
}

}  // namespace
}  // namespace shelfbeam
