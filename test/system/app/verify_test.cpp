// `plan` with a certificate, and `verify`, through the binary.

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "system/app/program.hpp"

namespace shelfbeam {
namespace {

using test::expect_silent;
using test::Json;
using testing::HasSubstr;

class VerifySlow : public testing::Test {
 protected:
  void SetUp() override {
    expect_silent({"new", "thesis", path("store"), "--quiet"});
    out_ = expect_silent({"plan", store(), "-o", path("plan"), "--relative-error", "0.05"});
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string store() const { return path("store/store.json"); }

  test::TempFolder folder_;
  std::string out_;
};

// One plan of the paper's environment, and what can be asked of it.
TEST_F(VerifySlow, TellsWhatAPlanReaches) {
  EXPECT_THAT(out_,
              HasSubstr("certificate: 4 transceivers reach all 390 labels, and 3 cannot reach all, with "
                        "joint confidence 99 %."));
  const auto answer = Json::parse(read_file(path("plan/placement.json")));
  const auto& certificate = answer["certificate"];
  EXPECT_EQ(certificate["reached"], 390);
  EXPECT_EQ(certificate["count_lower_bound"], 4);
  EXPECT_TRUE(certificate["missed"].empty());
  EXPECT_TRUE(certificate["undecided"].empty());
  EXPECT_THAT(read_file(path("plan/report.html")),
              HasSubstr("4 transceivers reach all 390 labels, and 3 cannot reach all"));

  // The report that is made again says the same.
  const std::string report = read_file(path("plan/report.html"));
  expect_silent({"report", path("plan"), "--quiet"});
  EXPECT_EQ(read_file(path("plan/report.html")), report);

  const std::string same = expect_silent(
      {"verify", store(), path("plan/placement.json"), "-o", path("verification.csv"), "--json"});
  EXPECT_EQ(Json::parse(same)["reached"], 390);
  EXPECT_THAT(
      read_file(path("verification.csv")),
      HasSubstr("id,verdict,requirement,signal,standard_error,lower,upper,samples\nA1-front-1-1,reached,"));

  // What hangs, from a list; one of the four less misses labels, and any type must be known.
  EXPECT_THAT(expect_silent({"verify", store(), path("plan/placement.csv")}),
              HasSubstr("4 transceivers reach all 390 labels, with joint confidence 99 %."));
  std::string units = read_file(path("plan/placement.csv"));
  units.erase(units.find_last_of('\n', units.size() - 2) + 1);
  write_file(path("three.csv"), units);
  EXPECT_THAT(expect_silent({"verify", store(), path("three.csv"), "--budget", "20"}, 1),
              HasSubstr("labels are missed."));

  write_file(path("wrong.csv"), "id,x,y,z,ax,ay,az,roll_deg,type\nU,1,1,2,0,0,-1,0,nonsense\n");
  test::expect_refused(folder_, {"verify", store(), path("wrong.csv")}, {"wrong.csv", "nonsense"});
  // The store would be overwritten.
  test::expect_refused(folder_, {"verify", store(), path("plan/placement.json"), "-o", store()},
                       {"store.json"});
}

}  // namespace
}  // namespace shelfbeam
