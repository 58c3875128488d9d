// Tests a shop that changes through the program: plan, verify, inspect and simulate.

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shelfbeam/plan/io/plan_file.hpp"
#include "shelfbeam/report/data/shop_states.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

#include "system/app/program.hpp"
#include "unit/plan/states/known_states.hpp"

namespace shelfbeam {
namespace {

using test::Json;
using testing::HasSubstr;
using testing::StartsWith;

class States : public test::ProgramTest {
 protected:
  void SetUp() override {
    folder.write("store.json", test::KnownStates({{{0.01, 0.01}, {0.1, 0.1}, {0.01, 0.2}}}).text());
  }
};

class StatesSlow : public States {};

TEST_F(StatesSlow, ArePlannedAndVerified) {
  EXPECT_THAT(told("plan @store.json -o @plan --samples 500"),
              HasSubstr("4 transceivers reach every label at least 95 % of the time, with 99 % confidence."));
  const Json states = json("plan/placement.json")["states"];
  EXPECT_EQ(states["count"], 100);
  EXPECT_EQ(states["availability"], 0.95);
  EXPECT_EQ(states["confidence"], 0.99);
  EXPECT_EQ(states["certified"], true);
  EXPECT_EQ(states["labels_below"], 0);
  EXPECT_EQ(states["sample_count"], 4);
  EXPECT_EQ(states["sample_lower_bound"], 4);
  EXPECT_EQ(states["certified_count"], 4);
  EXPECT_EQ(states["nominal"]["labels_below"], 1);
  EXPECT_EQ(json("plan/placement.json")["verification"], "states");
  EXPECT_THAT(bytes("plan/verification.csv"), StartsWith("id,required,states,missed,availability\nL0,0.95,"));
  EXPECT_THAT(bytes("plan/labels.csv"), HasSubstr(",availability,description,fixture,face,board\n"));
  const std::string report = bytes("plan/report.html");
  EXPECT_THAT(report, HasSubstr("While the shop changes"));
  told("report @plan --quiet");
  EXPECT_EQ(bytes("plan/report.html"), report);

  EXPECT_THAT(told("verify @store.json @plan/placement.json --states 300"),
              HasSubstr("4 transceivers reach every label at least 95 % of the time, with 99 % confidence."));
  const std::string units =
      "id,x,y,z,ax,ay,az,roll_deg,type\nA,1,2,2.9,0,0,-1,0,t\nB,1,6,2.9,0,0,-1,0,t\n"
      "C,1,10,2.9,0,0,-1,0,t\n";
  folder.write("units.csv", units);
  const std::string answer = told("verify @store.json @units.csv --states 300 -o @units-states.csv", 1);
  EXPECT_THAT(answer, HasSubstr("Undecided labels: L1, reached "));
  EXPECT_THAT(answer, HasSubstr("The best addition is U11 at (11, 6, 2.9) m"));
  EXPECT_THAT(bytes("units-states.csv"), HasSubstr("L1,0.95,300,"));
  refused("verify @store.json @units.csv --states 300 --availability 95% --mean-missed 2", {"--mean-missed"});
}

// The labels of a shop with known states that are missed in the states of a page: their chosen units stand
// behind pallets.
std::vector<std::vector<LabelId>> missed_on_page(const CertifiedPlan& answer,
                                                 const std::vector<ShopState>& page) {
  std::vector<std::vector<LabelId>> missed;
  for (const ShopState& state : page) {
    std::set<std::uint32_t> blocked;  // units: U00, U01, U10, ...
    for (const ShopState::Block& block : state.blocks)
      blocked.insert(2 * static_cast<std::uint32_t>(block.footprint[0][1] / 4) +
                     (block.footprint[0][0] > 6 ? 1 : 0));
    std::set<LabelId> labels{0, 1, 2};
    for (const std::uint32_t j : answer.placement.selected)
      if (!blocked.contains(j)) labels.erase(j / 2);
    missed.emplace_back(labels.begin(), labels.end());
  }
  return missed;
}

TEST_F(StatesSlow, OnThePageAreThoseThatWereExamined) {
  folder.write("store.json", test::KnownStates({{{0.3, 0.3}, {0.3, 0.3}, {0.3, 0.3}}}).text());
  told("simulate @store.json --samples 500 --seed 5 -o @signal.h5 --quiet");
  told("plan @store.json --availability 50% --states 20 --signal @signal.h5 --seed 2 -o @plan --quiet");
  EXPECT_EQ(json("plan/placement.json")["seed"], 2);
  const std::string report = bytes("plan/report.html");
  EXPECT_THAT(report, HasSubstr("2; 5 of the signals"));
  told("report @plan --quiet");
  EXPECT_EQ(bytes("plan/report.html"), report);

  const Store store = read_store(folder / "plan/store.json");
  const Scene scene = make_scene(store);
  const SignalMatrix matrix = read_signal_file(folder / "plan/signal.h5");
  CertifiedPlan answer = read_plan(folder / "plan/placement.json", make_signal_table(matrix));
  std::vector<std::vector<LabelId>> examined;
  ASSERT_TRUE(answer.availability);
  for (const ShownState& state : answer.availability->shown) examined.push_back(state.missed);
  ASSERT_GE(examined.size(), 4U);
  EXPECT_EQ(missed_on_page(answer, shop_states(store, scene, matrix, answer)), examined);
  answer.seed = 5;
  EXPECT_NE(missed_on_page(answer, shop_states(store, scene, matrix, answer)), examined);

  const std::string number = std::to_string(answer.availability->shown[0].number);
  told("inspect @store.json --seed 2 -o @state.json --quiet --state " + number);
  answer.seed = 2;
  const std::size_t boxes = shop_states(store, scene, matrix, answer)[0].blocks.size();
  EXPECT_EQ(json("state.json")["fixtures"].size(), json("plan/store.json")["fixtures"].size() + boxes);
}

TEST_F(States, AreExportedAndSimulatedWithTheSameBytes) {
  told("inspect @store.json --state 17 -o @state17.json --quiet");
  told("simulate @state17.json -o @exported.h5 --samples 500 --quiet");
  told("simulate @store.json --state 17 -o @state.h5 --samples 500 --quiet");
  const std::string exported = bytes("exported.h5");
  EXPECT_TRUE(bytes("state.h5") == exported);
  told("simulate @store.json -o @state.h5 --samples 500 --quiet");
  EXPECT_FALSE(bytes("state.h5") == exported) << "the control: the shop as the file gives it";

  told("simulate @store.json --states 3 --hard-labels 2 -o @one.h5 --threads 1 --quiet");
  told("simulate @store.json --states 3 --hard-labels 2 -o @two.h5 --threads 2 --quiet");
  EXPECT_TRUE(bytes("one.h5") == bytes("two.h5"));
  refused("plan @state17.json -o @plan --states 10", {"state17.json", "variation"});
}

}  // namespace
}  // namespace shelfbeam
