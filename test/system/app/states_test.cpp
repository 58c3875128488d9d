// Tests a shop that changes through the program: plan, verify, inspect and simulate.

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
  EXPECT_THAT(bytes("plan/labels.csv"), HasSubstr(",availability\n"));
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
