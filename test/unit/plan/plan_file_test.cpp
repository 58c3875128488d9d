#include "shelfbeam/plan/io/plan_file.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/placement/io/placement_file.hpp"

#include "support/expect_input_error.hpp"
#include "support/temp_folder.hpp"
#include "unit/placement/random_table.hpp"

namespace shelfbeam {
namespace {

SignalTable example() {
  return test::make_table({{0.5, 0.75}, {0.25, 0.5}}, 2);
}

// Two units that reach one label.
CertifiedPlan example_plan() {
  CertifiedPlan plan;
  plan.placement.selected = {0, 1};
  plan.placement.count_lower_bound = plan.placement.lower_bound = 1;
  plan.placement.objective_value = 2;
  plan.curve.points = {{1, 0, 1}, {2, 2, 2}};
  plan.curve.is_complete = false;
  Certificate& certificate = plan.certificate.emplace();
  certificate.labels = {{Verdict::reached, 2}, {Verdict::undecided, 2}};
  certificate.count_lower_bound = 1;
  certificate.open = {.cause = EndCause::proof_cost, .bound = 2, .leaves_cheaper = true};
  Sensitivity& sensitivity = plan.sensitivity.emplace();
  sensitivity.as_given = {1.25, 0.01, 1};
  sensitivity.low = {{0.75, 0.02, 0}, {0}, {1}};
  sensitivity.high = {{1.5, 0.03, 1}, {}, {}};
  MaterialSensitivity floor{"floor", 0.5, 0.4, 0.6, true, {}, {}};
  floor.at_lower = {{0.875, 0.01, 0}, -0.375, 0.001, -0.125, 1};
  floor.at_upper = {{1.375, 0.01, 1}, 0.125, 0.002, 0.0625, 0};
  sensitivity.materials = {floor};
  sensitivity.kept = {"glass"};
  sensitivity.watched = 2;
  sensitivity.batches = 64;
  sensitivity.seconds = 1.5;
  return plan;
}

TEST(PlanFile, IsReadBack) {
  const test::TempFolder folder;
  const std::string text = plan_json(example_plan(), example());
  const CertifiedPlan read = read_plan(folder.write("p.json", text), example());
  EXPECT_EQ(plan_json(read, example()), text);
  ASSERT_TRUE(read.certificate && read.sensitivity);
  EXPECT_EQ(read.certificate->confidence, 0.99);
  EXPECT_EQ(read.certificate->labels[0].verdict, Verdict::reached);
  EXPECT_EQ(read.certificate->labels[1].verdict, Verdict::undecided);
  EXPECT_EQ(read.sensitivity->holds(), Verdict::missed);
  EXPECT_EQ(read.sensitivity->low.undecided, std::vector<LabelId>{1});
  EXPECT_EQ(read.sensitivity->materials.at(0).at_upper.min_margin.label, 1U);
  ASSERT_EQ(read.curve.points.size(), 2U);
  EXPECT_EQ(read.curve.points[1].at_least, 2U);
  EXPECT_FALSE(read.curve.is_complete);
}

TEST(PlanFile, NamesTheLabelsOfItsLists) {
  const test::TempFolder folder;
  CertifiedPlan plan = example_plan();
  const SignalTable table = example();
  plan.sensitivity.reset();
  plan.certificate->labels[1].verdict = Verdict::missed;
  std::vector<Label> labels(3);
  for (std::size_t k = 0; k < table.rows(); ++k) labels[k].id = table.labels[k].id;
  const std::string plain = plan_json(plan, table, labels);
  EXPECT_EQ(plain, plan_json(plan, table)) << "a store without descriptions";
  labels[0].description = "Rye bread";
  labels[1].description = "Rolls";
  labels[2].id = "elsewhere";
  labels[2].description = "Jam";
  const auto names = [&] {
    return nlohmann::json::parse(plan_json(plan, table, labels)).value("label_names", nlohmann::json());
  };
  EXPECT_EQ(names(), (nlohmann::json{{table.labels[0].id, "Rye bread"}, {table.labels[1].id, "Rolls"}}))
      << "the critical and the missed one";
  EXPECT_EQ(plan_json(read_plan(folder.write("p.json", plan_json(plan, table, labels)), table), table),
            plain);
  plan.placement.selected = {0};
  plan.certificate->labels[1].verdict = Verdict::unverified;
  EXPECT_FALSE(names().contains(table.labels[1].id)) << "not verified yet";
  plan.placement.unreachable = {{1, 2, 1.5}};
  EXPECT_TRUE(names().contains(table.labels[1].id));
}

TEST(PlanFile, KeepsItsSeed) {
  const test::TempFolder folder;
  CertifiedPlan plan = example_plan();
  EXPECT_FALSE(read_plan(folder.write("none.json", plan_json(plan, example())), example()).seed);
  plan.seed = 18'446'744'073'709'551'615U;  // no double has this value
  const std::string text = plan_json(plan, example());
  EXPECT_EQ(read_plan(folder.write("p.json", text), example()).seed, plan.seed);
  auto file = nlohmann::ordered_json::parse(text);
  for (const char* other : {"-1", "1.5", "\"1\""}) {
    file["seed"] = nlohmann::ordered_json::parse(other);
    test::expect_input_error([&] { read_plan(folder.write("p.json", file.dump()), example()); }, "seed",
                             "whole number");
  }
}

TEST(PlanFile, KeepsStatesOfTheShop) {
  const test::TempFolder folder;
  CertifiedPlan plan{example_plan().placement};
  Availability& availability = plan.availability.emplace();
  availability.required = {0.95, 0.9};
  availability.examined = {{2, 300, {0, 12}, 12}};
  for (StateOutcome* sampled : {&availability.nominal, &availability.sample})
    *sampled = {1, 100, {1, 40}, 41};
  availability.shown = {{1'000'000, {}}, {1'000'217, {0, 1}}};
  availability.responsible = {1};
  availability.open = {EndCause::time_limit};
  const std::string text = plan_json(plan, example());
  const CertifiedPlan read = read_plan(folder.write("p.json", text), example());
  EXPECT_EQ(plan_json(read, example()), text);
  ASSERT_TRUE(read.availability);
  ASSERT_EQ(read.availability->shown.size(), 2U);
  EXPECT_EQ(read.availability->shown[1].number, 1'000'217U);
  EXPECT_EQ(read.availability->shown[0].missed, std::vector<LabelId>());
  EXPECT_EQ(read.availability->shown[1].missed, (std::vector<LabelId>{0, 1}));
}

TEST(PlanFile, ReadsWarningsOfEarlierVersions) {
  const test::TempFolder folder;
  auto json = nlohmann::ordered_json::parse(plan_json(example_plan(), example()));
  json["warnings"] = {"the shop is 32 m high"};
  const CertifiedPlan read = read_plan(folder.write("p.json", json.dump()), example());
  EXPECT_EQ(read.warnings, (std::vector<Finding>{{FindingCode::other, {}, {}, "the shop is 32 m high"}}));
}

TEST(PlanFile, DistinguishesUnverifiedLabels) {
  const test::TempFolder folder;
  CertifiedPlan plan = example_plan();
  plan.warnings = {{FindingCode::room_height, "room.size[2]", {32.0, "m"}, "the shop is 32 m high"}};
  plan.certificate->mark_unverified();
  std::string text = plan_json(plan, example());
  EXPECT_NE(text.find("\"reached\": 1"), std::string::npos) << text;
  CertifiedPlan read = read_plan(folder.write("p.json", text), example());
  EXPECT_EQ(read.certificate->labels[1].verdict, Verdict::unverified);
  EXPECT_EQ(read.warnings, plan.warnings);

  plan.certificate->labels[0].verdict = Verdict::undecided;
  plan.certificate->mark_unverified();
  text = plan_json(plan, example());
  EXPECT_NE(text.find("\"reached\": null"), std::string::npos) << text;
  read = read_plan(folder.write("p.json", text), example());
  EXPECT_TRUE(read.certificate->none_verified());
  EXPECT_EQ(plan_json(read, example()), text);
}

// A reader of the placement alone can read a plan, and a placement alone is a plan without the rest.
TEST(PlanFile, ExtendsThePlacementFile) {
  const test::TempFolder folder;
  const CertifiedPlan whole = example_plan();
  const std::string bare = placement_json(whole.placement, example());
  const auto path = folder.write("p.json", plan_json(whole, example()));
  EXPECT_EQ(placement_json(read_placement(path, example()), example()), bare);
  const CertifiedPlan read = read_plan(folder.write("bare.json", bare), example());
  EXPECT_FALSE(read.certificate);
  EXPECT_FALSE(read.sensitivity);
  EXPECT_TRUE(read.curve.points.empty());
  EXPECT_EQ(plan_json(read, example()), bare);
}

TEST(PlanFile, RejectsInconsistentContents) {
  const std::string whole = plan_json(example_plan(), example());
  struct Case {
    std::string from, to, place, problem;
  };
  for (const auto& [from, to, place, problem] : std::vector<Case>{
           {"\"reached\": 1", "\"reached\": 2", "certificate.reached", ""},
           {"\"holds\": \"no\"", "\"holds\": \"yes\"", "sensitivity.holds", "'low'"},
           {"\"assumed\": true", "\"assumd\": true", "sensitivity.materials[0]", "assumd"},
           {"\"labels_short\": 1", "\"labels_short\": -1", "sensitivity.materials[0].low.labels_short", "-1"},
           {"\"watched\": 2", "\"watched\": 0.5", "sensitivity.watched", "0.5"},
           {"\"at_most\": 2", "\"at_most\": 3", "curve[1].at_most", "3"},
           {"\"at_most\": 2", "\"at_most\": 1", "curve[1].at_most", "1"},
           {"\"units\": 2", "\"units\": 1", "curve[1].units", "1"}}) {
    std::string text = whole;
    ASSERT_NE(text.find(from), std::string::npos) << from;
    text.replace(text.find(from), from.size(), to);
    const auto read = [](const auto& path) { read_plan(path, example()); };
    test::expect_file_refused(read, text, place, problem);
  }
}

}  // namespace
}  // namespace shelfbeam
