#include "shelfbeam/report/difference/difference_report.hpp"

#include <nlohmann/json.hpp>

#include "shelfbeam/report/difference/difference_json.hpp"

#include "unit/report/shops.hpp"

namespace shelfbeam::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// The kiosk, whose ids need escaping, with some of its three units.
struct KioskPlan : PlannedShop {
  explicit KioskPlan(const Selection& selected, const Store& of = kiosk()) : PlannedShop(of) {
    placement.selected = selected;
    placement.objective_value = static_cast<double>(placement.count());
  }
  ComparedPlan compared() const { return compared_plan(matrix, plan, resolved_store_json(store, scene)); }
};

struct TwoPlans {
  ComparedPlan before, after;
  PlanDifference difference = difference_of(before, after);
  DifferenceInput input{before, after, difference};
};

std::string answer_to(const KioskPlan& before, const KioskPlan& after) {
  return difference_answer(english(), TwoPlans{before.compared(), after.compared()}.input);
}

TEST(DifferenceReport, AnswersInOneSentence) {
  KioskPlan all({0, 1, 2}), two({0, 1}), none({}), other({0, 2});
  none.placement.objective_value = std::numeric_limits<double>::infinity();
  for (KioskPlan* one : {&all, &two, &none, &other}) {
    one->placement.price.reset();
    for (LabelRow& label : one->matrix.labels) label.requirement = 1e-9;
  }
  EXPECT_EQ(answer_to(all, all), "The plans do not differ.");
  EXPECT_EQ(answer_to(all, two), "One unit fewer: 2 instead of 3; all 20 labels stay reached.");
  EXPECT_EQ(answer_to(two, all), "One unit more: 3 instead of 2; all 20 labels stay reached.");
  EXPECT_EQ(answer_to(none, two),
            "2 units, where the first plan has no selection; 0 of 20 labels stay reached, 20 gained.");
  EXPECT_EQ(answer_to(two, none),
            "No selection, where the first plan has 2 units; 0 of 20 labels stay reached, 20 lost.");
  EXPECT_EQ(answer_to(two, other), "2 units as before, 1 of them changed; all 20 labels stay reached.");
  other.placement.price = {"EUR", 200, 200};
  two.placement.price = {"EUR", 300, 250};
  EXPECT_EQ(answer_to(two, other),
            "2 units as before, 1 of them changed; 200 EUR to spend instead of 250 EUR; "
            "all 20 labels stay reached.");
  two.placement.price->currency = "USD";
  EXPECT_EQ(answer_to(two, other), "2 units as before, 1 of them changed; all 20 labels stay reached.");
  other.matrix.labels[3].requirement = 1e9;
  EXPECT_EQ(answer_to(all, other), "One unit fewer: 2 instead of 3; 19 of 20 labels stay reached, 1 lost.");
  other.matrix.labels[4].id = "new";
  other.matrix.labels[4].position.x += 1;
  EXPECT_EQ(answer_to(all, other),
            "One unit fewer: 2 instead of 3; 18 of 19 labels stay reached, 1 lost, 1 new label reached, "
            "1 label is gone.");
}

TEST(DifferenceReport, PageContainsBothPlans) {
  KioskPlan before({0, 1}), after({1, 2});
  after.matrix.transceivers[1].position.x -= 1;
  after.matrix.labels[0].requirement = 1e9;
  after.store.materials[0].material = Lambertian{0.5};
  const TwoPlans compared{before.compared(), after.compared()};
  const Page page(difference_html({compared.input, after.scene, "plan<1>", "plan&2"}));
  EXPECT_THAT(missing_in(page.text, {"plan<1> and plan&2", "1 changed, 1 added, 1 removed", "T&1", "T,2",
                                     "T\"3\"", "1 label lost", "grey: reflectance 0.5 instead of 0.7",
                                     "label lost", "changed unit", "removed unit"}),
              testing::IsEmpty());
  EXPECT_FALSE(page.has_text("label gained")) << "negative control";
  EXPECT_EQ(count_of("href=\"#unit-added\"", page.html), 2U) << "the unit and its key";
  EXPECT_EQ(count_of("href=\"#unit-removed\"", page.html), 3U) << "also the old place of the moved unit";
}

TEST(DifferenceReport, NamesFewElementsWithTheirValuesAndManyByRanges) {
  Store moved = kiosk();
  std::get<Gondola>(moved.fixtures[0].value).at = {1.5, 2.5};
  const TwoPlans compared{KioskPlan({}).compared(), KioskPlan({}, moved).compared()};
  EXPECT_THAT(store_lines(english(), compared.difference),
              ElementsAre("Fixtures: 1 moved, A<1>: at [1.5, 2.5] instead of [1.5, 2]",
                          "Labels: 20 moved, A<1>-front-1-1…5, A<1>-front-2-1…5, A<1>-back-1-1…5, "
                          "A<1>-back-2-1…5"));
}

// The bound of a plan for a part of the labels does not hold for plans for all of them.
TEST(DifferenceReport, NamesTheGoalOfAPartialPlan) {
  KioskPlan all({0, 1, 2}), part({0});
  for (KioskPlan* one : {&all, &part})
    one->placement.count_lower_bound = static_cast<double>(one->placement.count());
  part.placement.partial = {ReachGoal::share, 0.5, 10, 20};
  const TextTable figures = difference_figures(english(), TwoPlans{all.compared(), part.compared()}.input);
  EXPECT_THAT(figures.back(), ElementsAre("Aim", "all labels", "50.0\u00a0% of the labels"));
  for (const std::vector<std::string>& row : figures) EXPECT_THAT(row.front(), Not(HasSubstr("all labels")));
}

TEST(DifferenceReport, JsonHasTheSameLists) {
  KioskPlan before({0, 1}), after({1, 2});
  after.placement.min_spacing = 2;
  after.matrix.labels[0].requirement = 1e9;
  const auto json = difference_json(TwoPlans{before.compared(), after.compared()}.input);
  EXPECT_EQ(json["differs"], true);
  EXPECT_EQ(json["units"]["kept"][0]["after"]["id"], "T,2");
  EXPECT_EQ(json["units"]["added"][0]["id"], "T\"3\"");
  EXPECT_EQ(json["units"]["removed"][0]["id"], "T&1");
  EXPECT_EQ(json["labels"]["lost"].size(), 1U);
  EXPECT_EQ(json["labels"]["lost"][0]["id"], after.matrix.labels[0].id);
  EXPECT_EQ(json["labels"]["lost"][0]["before"]["reached"], true);
  EXPECT_EQ(json["question"],
            nlohmann::ordered_json::parse(R"([{"key": "min_spacing", "before": null, "after": 2}])"));
  EXPECT_TRUE(json["store"].empty());
}

}  // namespace
}  // namespace shelfbeam::test
