#include "shelfbeam/placement/io/placement_file.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/placement/answer/names.hpp"
#include "shelfbeam/signal/constraints/conflicts.hpp"

#include "support/documentation.hpp"
#include "support/expect_input_error.hpp"
#include "support/temp_folder.hpp"
#include "unit/placement/random_table.hpp"

namespace shelfbeam {
namespace {

SignalTable example() {
  return test::make_table({{0.5, 0.75}, {0.25, 0.5}}, 2);
}

Placement solved() {
  Placement placement;
  placement.problem = {CommunicationModel::non_cooperative, Objective::effective_links, Combination::weighted,
                       0.5};
  placement.status = Status::stopped;
  placement.selected = {0, 1};
  placement.count_lower_bound = 1;
  placement.objective_value = 4;
  placement.lower_bound = 3.5;
  placement.bound_proof = BoundProof::log;
  placement.ties_settled = true;
  placement.unit_costs = true;
  placement.solver = {Method::mip, "highs 1.10.0"};
  placement.seconds = 0.25;
  return placement;
}

TEST(PlacementFile, HasTheDocumentedKeysInOrder) {
  EXPECT_EQ(placement_json(solved(), example()), R"({
  "format": 2,
  "model": "non-cooperative",
  "objective": "effective-links",
  "combination": "weighted",
  "share": 0.5,
  "survives_failure": false,
  "min_spacing": null,
  "forbidden_pairs": 0,
  "labels": 2,
  "selected": [
    "T0",
    "T1"
  ],
  "count": 2,
  "count_lower_bound": 1,
  "objective_value": 4.0,
  "lower_bound": 3.5,
  "gap": 0.125,
  "bound_proof": "log",
  "ties_settled": true,
  "unit_costs": true,
  "redundant_share": 0.0,
  "status": "stopped",
  "solver": "mip",
  "backend": "highs 1.10.0",
  "unreachable": [],
  "scenarios": [],
  "verification": "not verified yet",
  "critical": [
    {
      "unit": "T0",
      "count": 0,
      "labels": []
    },
    {
      "unit": "T1",
      "count": 0,
      "labels": []
    }
  ]
}
)");
}

// Both units reach one of two labels, by hand and not by the checker.
TEST(PlacementFile, HasTheShareOfRedundantLabels) {
  const std::string json = placement_json(solved(), test::make_table({{3, 3}, {3, 0.5}}, 2));
  EXPECT_NE(json.find("\"redundant_share\": 0.5,"), std::string::npos) << json;
}

TEST(PlacementFile, IsReadBack) {
  const test::TempFolder folder;
  const auto path = folder.write("placement.json", placement_json(solved(), example()));
  const Placement read = read_placement(path, example());
  EXPECT_EQ(placement_json(read, example()), placement_json(solved(), example()));
  EXPECT_EQ(read.selected, solved().selected);
}

TEST(PlacementFile, StatesItsConflicts) {
  const test::TempFolder folder;
  SignalTable table = test::make_table({{1, 0, 1}, {0, 1, 1}}, 3);
  table.transceivers[0].position = {0, 0, 3};
  table.transceivers[1].position = {2, 0, 3};
  table.transceivers[2].position = {9, 0, 3};
  add_conflicts(table, 2.5, "table");
  for (const Status status : {Status::optimal, Status::infeasible}) {
    if (status == Status::infeasible) {  // without the signal of unit 2
      table.entries = {{0, 1}, {1, 1}};
      table.row_begin = {0, 1, 2};
    }
    const Placement found = place(table, {}, {});
    EXPECT_EQ(found.status, status);
    const std::string text = placement_json(found, table);
    EXPECT_NE(text.find("\"min_spacing\": 2.5,\n  \"forbidden_pairs\": 1,\n"), std::string::npos) << text;
    // The table of a report contains none of it.
    SignalTable bare = table;
    bare.conflicts.clear();
    bare.min_spacing = 0;
    const Placement read = read_placement(folder.write("p.json", text), bare);
    EXPECT_EQ(read.min_spacing, 2.5);
    EXPECT_EQ(read.forbidden_pairs, 1U);
    EXPECT_EQ(placement_json(read, bare), text);
  }
}

// The documented example is a placement for the problem that its labels and units define.
TEST(PlacementFile, ReadsTheDocumentedExample) {
  const std::string example = test::fenced_blocks("placement.md", "json").at(0);
  SignalTable table = test::make_table({{1, 0, 0}, {1, 0, 0}, {0.5, 0.75, 0}, {0, 0.25, 1.5}}, 3);
  const std::vector<std::string> labels = {"A1-front-0", "A1-front-1", "B2-back-6", "B2-back-7"};
  for (std::size_t i = 0; i < labels.size(); ++i) table.labels[i].id = labels[i];
  const std::vector<std::string> units = {"G0-3-2", "G0-9-7", "G0-15-12"};
  for (std::size_t j = 0; j < units.size(); ++j) table.transceivers[j].id = units[j];

  const test::TempFolder folder;
  const Placement read = read_placement(folder.write("p.json", example), table);
  using Json = nlohmann::ordered_json;
  EXPECT_EQ(Json::parse(placement_json(read, table)).dump(1), Json::parse(example).dump(1));
  Placement found = place(table, {}, {});
  found.seconds = read.seconds;
  EXPECT_EQ(Json::parse(placement_json(found, table)).dump(1), Json::parse(example).dump(1));
}

TEST(PlacementFile, OfEarlierVersionsHasNoProofs) {
  const test::TempFolder folder;
  std::string text = placement_json(solved(), example());
  for (const std::string line : {"  \"bound_proof\": \"log\",\n", "  \"ties_settled\": true,\n"}) {
    ASSERT_NE(text.find(line), std::string::npos);
    text.erase(text.find(line), line.size());
  }
  const Placement read = read_placement(folder.write("p.json", text), example());
  EXPECT_EQ(read.bound_proof, BoundProof::trivial);
  EXPECT_FALSE(read.ties_settled);
}

TEST(PlacementFile, NamesEveryProof) {
  const test::TempFolder folder;
  Placement placement = solved();
  for (const auto& [name, proof] : names_of<BoundProof>) {
    placement.bound_proof = proof;
    const std::string text = placement_json(placement, example());
    EXPECT_NE(text.find("\"bound_proof\": \"" + std::string(name) + "\""), std::string::npos);
    EXPECT_EQ(read_placement(folder.write("p.json", text), example()).bound_proof, proof);
  }
}

TEST(PlacementFile, WritesResultsWithoutNumbers) {
  const SignalTable table = example();
  const Placement none = place(table, {}, {});
  ASSERT_EQ(none.status, Status::infeasible);
  const std::string text = placement_json(none, table);
  for (const char* key : {"count_lower_bound", "objective_value", "lower_bound", "gap"})
    EXPECT_NE(text.find(std::string("\"") + key + "\": null"), std::string::npos) << key << text;
  EXPECT_NE(text.find("\"label\": \"L1\""), std::string::npos);
  EXPECT_NE(text.find("\"most\": 0.75"), std::string::npos);

  const test::TempFolder folder;
  const Placement read = read_placement(folder.write("p.json", text), table);
  EXPECT_EQ(read.status, Status::infeasible);
  EXPECT_TRUE(std::isinf(read.lower_bound));
  EXPECT_EQ(placement_json(read, table), text);
}

TEST(PlacementFile, WritesStoppedSearchesWithoutASelection) {
  SignalTable table = test::make_table({{1, 0}, {0, 1}}, 2);
  table.mounts = {{0, 1}};
  const Placement stopped = place(table, {}, {.solver = SolverChoice::greedy});
  const std::string text = placement_json(stopped, table);
  for (const char* part : {"\"selected\": []", "\"count\": 0", "\"count_lower_bound\": 1",
                           "\"objective_value\": null", "\"status\": \"stopped\""})
    EXPECT_NE(text.find(part), std::string::npos) << part << text;
  const test::TempFolder folder;
  EXPECT_EQ(placement_json(read_placement(folder.write("p.json", text), table), table), text);
}

TEST(PlacementFile, RejectsTwoOptionsOfAMountingPoint) {
  SignalTable table = example();
  table.mounts = {{0, 1}};
  test::expect_file_refused([&](const auto& path) { read_placement(path, table); },
                            placement_json(solved(), example()), "selected: ", "'T0' and 'T1'");
}

TEST(PlacementFile, RejectsInconsistentContents) {
  const auto read = [](const auto& path) { read_placement(path, example()); };
  const auto expect = [&](const std::string& from, const std::string& to, std::string_view place,
                          std::string_view problem) {
    std::string text = placement_json(solved(), example());
    ASSERT_NE(text.find(from), std::string::npos) << from;
    text.replace(text.find(from), from.size(), to);
    test::expect_file_refused(read, text, place, problem);
  };
  expect("\"T1\"", "\"T0\"", "selected[1]", "T0");
  expect("\"T1\"", "1", "selected[1]", "number");
  expect("\"count\": 2", "\"count\": 3", "count", "3");
  expect("\"labels\": 2", "\"labels\": 3", "labels", "2 labels");
  expect("\"min_spacing\": null", "\"min_spacing\": -1", "min_spacing", "-1");
  expect("\"forbidden_pairs\": 0", "\"forbidden_pairs\": -1", "forbidden_pairs", "-1");
  expect("\"format\": 2", "\"format\": 3", "format", "3");
  expect("weighted", "wieghted", "combination", "weighted");
  expect("\"status\": \"stopped\"", "\"status\": \"stoped\"", "status", "stopped");
  expect("\"solver\"", "\"slover\"", "slover", "solver");
  expect("\"bound_proof\": \"log\"", "\"bound_proof\": \"lok\"", "bound_proof", "log");
  expect("\"share\": 0.5", "\"share\": 0", "share", "0");
  expect("\"lower_bound\": 3.5", "\"lower_bound\": true", "lower_bound", "number");
  expect("\"unreachable\": []", "\"unreachable\": [{\"label\": \"X\", \"requirement\": 1, \"most\": 0}]",
         "unreachable[0].label", "X");
  test::expect_input_error([&] { read("missing.json"); }, "missing.json");
}

}  // namespace
}  // namespace shelfbeam
