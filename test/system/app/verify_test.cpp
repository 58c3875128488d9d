// Tests `plan` with a certificate, and `verify`, through the program.

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "system/app/program.hpp"

namespace shelfbeam {
namespace {

using test::Json;
using testing::HasSubstr;
using testing::StartsWith;

class VerifySlow : public test::ProgramTest {};

// One plan of the paper's environment, and the ways to verify it.
TEST_F(VerifySlow, VerifiesThePlan) {
  const std::string store = "@store/store.json",
                    statement = "4 transceivers reach all 390 labels, and 3 are not enough";
  told("new thesis @store --quiet");
  EXPECT_THAT(told("plan " + store + " -o @plan --samples 2000"),
              StartsWith(statement + ", with 99 % confidence. This "));
  const Json certificate = json("plan/placement.json")["certificate"];
  EXPECT_EQ(certificate["reached"], 390);
  EXPECT_EQ(certificate["count_lower_bound"], 4);
  EXPECT_TRUE(certificate["missed"].empty());
  EXPECT_TRUE(certificate["undecided"].empty());
  const std::string report = bytes("plan/report.html");
  EXPECT_THAT(report, HasSubstr(statement));

  // A rewritten report is identical.
  told("report @plan --quiet");
  EXPECT_EQ(bytes("plan/report.html"), report);
  const Json same =
      Json::parse(told("verify " + store + " @plan/placement.json -o @verification.csv --json"));
  EXPECT_EQ(same["reached"], 390);
  EXPECT_THAT(
      bytes("verification.csv"),
      HasSubstr("id,verdict,requirement,signal,standard_error,lower,upper,samples\nA1-front-1-1,reached,"));

  // Verifies mounted units from a list. Without one of the four, labels are missed; every type must be known.
  EXPECT_THAT(told("verify " + store + " @plan/placement.csv"),
              HasSubstr("4 transceivers reach all 390 labels, with 99 % confidence."));
  std::string units = bytes("plan/placement.csv");
  folder.write("three.csv", units.erase(units.find_last_of('\n', units.size() - 2) + 1));
  EXPECT_THAT(told("verify " + store + " @three.csv --budget 5", 1), HasSubstr("labels are missed."));
  folder.write("wrong.csv", "id,x,y,z,ax,ay,az,roll_deg,type\nU,1,1,2,0,0,-1,0,nonsense\n");
  refused("verify " + store + " @wrong.csv", {"wrong.csv", "nonsense"});
  // The store would be overwritten.
  refused("verify " + store + " @plan/placement.json -o " + store, {"store.json"});
}

}  // namespace
}  // namespace shelfbeam
