#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "system/app/program.hpp"

namespace shelfbeam {
namespace {

using test::expect_silent;
using test::Json;

const std::vector<std::string> verbs = {"new",    "inspect", "simulate", "place", "plan",
                                        "verify", "report",  "compare",  "diff",  "export"};

TEST(Help, OfEveryVerbShowsExamplesAndCommonOptions) {
  for (const std::string& verb : verbs) {
    const std::string help = expect_silent({verb, "--help"});
    EXPECT_NE(help.find(":\n  shelfbeam " + verb + " "), std::string::npos) << help;
    for (const char* option : {"--seed", "--threads", "--quiet", "--json"})
      EXPECT_NE(help.find(option), std::string::npos) << verb << ' ' << option;
  }
}

TEST(Help, OptionsWorkAsDescribed) {
  const std::string help = expect_silent({"--help"});
  for (const std::string& verb : verbs) EXPECT_NE(help.find("\n  " + verb + " "), std::string::npos) << verb;
  EXPECT_NE(help.find("Exit codes: 0 success; 1"), std::string::npos);
  for (const char* verb : {"place", "plan"}) {
    const std::string solvers = expect_silent({verb, "--help"});
    for (const char* solver : {"auto (default): ", "search: ", "mip: ", "greedy: "})
      EXPECT_NE(solvers.find(solver), std::string::npos) << verb << ' ' << solver;
  }
}

TEST(Help, FitsTerminals) {
  std::vector<std::vector<std::string>> pages{{"--help"}};
  for (const std::string& verb : verbs) pages.push_back({verb, "--help"});
  for (const std::vector<std::string>& page : pages) {
    std::istringstream lines(expect_silent(page));
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
  }
}

TEST(Help, HasManyNames) {
  const std::string general = expect_silent({"--help"}), plan = expect_silent({"plan", "--help"});
  EXPECT_EQ(expect_silent({}), general);
  EXPECT_EQ(expect_silent({"-h"}), general);
  EXPECT_EQ(expect_silent({"help"}), general);
  EXPECT_EQ(expect_silent({"help", "plan"}), plan);
  EXPECT_EQ(expect_silent({"plan", "-h"}), plan);
  EXPECT_NE(plan.find("\nUsage: shelfbeam plan STORE -o PATH [OPTIONS]\n"), std::string::npos) << plan;
}

TEST(Version, IsAThreePartNumber) {
  const std::string version = expect_silent({"--version"});
  EXPECT_EQ(std::count(version.begin(), version.end(), '.'), 2);
  EXPECT_EQ(version.find_first_not_of("0123456789.\n"), std::string::npos);
}

class CommandLine : public test::ProgramTest {
 protected:
  CommandLine() { folder.write("matrix.csv", "label,T1,T2\nL1,1,2\nL2,3,0\n"); }
  // Runs every verb once with the flag.
  std::vector<std::pair<std::string, std::string>> outputs(const std::string& flag) const {
    std::vector<std::pair<std::string, std::string>> result;
    for (const std::string verb :
         {"new thesis @thesis\"1\"", "inspect @store.json -o @plan.svg",
          "simulate @store.json -o @signal.h5 --samples 2000",
          "place @matrix.csv --threshold 2 -o @placement.json", "plan @store.json -o @plan --samples 2000",
          "report @plan", "export @matrix.csv -o @model.lp --threshold 2"})
      result.emplace_back(verb.substr(0, verb.find(' ')), told(std::string(verb).append(" ").append(flag)));
    return result;
  }
};

TEST_F(CommandLine, QuietPrintsNothing) {
  for (const auto& [verb, out] : outputs("--quiet")) EXPECT_EQ(out, "") << verb;
}

TEST_F(CommandLine, JsonIsJson) {
  std::string run;
  for (const auto& [verb, out] : outputs("--json")) {
    EXPECT_TRUE(Json::parse(out).is_object()) << verb;
    run += verb + " ";
  }
  EXPECT_EQ(run, "new inspect simulate place plan report export ");
  EXPECT_EQ(Json::parse(read_file(folder / "placement.json"))["count"], 2);
}

TEST_F(CommandLine, WrongUseIsOneError) {
  const std::string store = path("store.json"), matrix = path("matrix.csv"), out = path("out");
  struct Case {
    std::vector<std::string> arguments;
    std::string message;
  };
  const std::vector<Case> cases = {
      {{"simulat"}, "'simulat'; did you mean 'simulate'?\n"},
      {{"simulat", "--help"}, "'simulat'; did you mean 'simulate'?\n"},
      {{"help", "simulat"}, "'simulat'; did you mean 'simulate'?\n"},
      {{"certify", store}, "'certify'"},
      {{"--frobnicate"}, "unknown option '--frobnicate'; see 'shelfbeam --help'"},
      {{"--quiet", "inspect", store}, "'--quiet' must follow the verb: shelfbeam inspect ... --quiet"},
      {{"--budget", "3"}, "'--budget' belongs to 'plan' and 'verify' and must follow the verb"},
      {{"inspect"}, "STORE is required; for example: shelfbeam inspect store.json -o plan.svg; see "},
      {{"plan", store}, "--output is required; for example: shelfbeam plan store.json -o plan; see "},
      {{"plan", store, "-o", out, "--sampels", "100"},
       "error: unknown option '--sampels'; did you mean '--samples'?\n"},
      {{"plan", "--sampels=100", store}, "error: unknown option '--sampels'; did you mean '--samples'?\n"},
      {{"plan", store, "-o", out, "-samples", "100"}, "'-samples'; did you mean '--samples'?"},
      {{"plan", store, "-output=" + out}, "'-output'; did you mean '--output'?"},
      {{"plan", store, "-o", out, "--conf", "0.9"}, "'--conf'; did you mean '--confidence'?"},
      {{"plan", store, "-o", out, "-x"}, "unknown option '-x'; see "},
      {{"simulate", store, "-o", out, "--budget", "3"},
       "'--budget' belongs to 'plan' and 'verify', not to 'simulate'; see "},
      {{"plan", store, "-o", out, "--by-bounce"}, "'--by-bounce' belongs to 'simulate', not to 'plan'; see "},
      {{"plan", store, "-o", out, "-o", out}, "--output is given more than once"},
      {{"plan", store, "-o", out, "--model", "coperative"},
       "--model: unknown value 'coperative'; did you mean 'cooperative'?"},
      {{"plan", store, "-o", out, "--samples", std::string(500, '7')},
       "--samples: '" + std::string(26, '7') + "..." + std::string(13, '7') +
           "' is not a whole number from 64 to"},
      {{"inspect", ""}, "STORE: "},
      {{"inspect", store, "--frobnicate"}, "'--frobnicate'; see 'shelfbeam inspect --help'"},
      {{"inspect", store, "extra"}, "unexpected argument 'extra'"},
      {{"inspect", store, "-o", ""}, "--output: "},
      {{"inspect", store, "--threads", "-1"}, "--threads"},
      {{"inspect", store, "--seed", "1.5"}, "--seed"},
      {{"inspect", store, "--state", "-1"}, "--state: '-1' is not a whole number"},
      {{"inspect", store, "--state", ""}, "--state: '' is not a whole number"},
      {{"inspect", store, "--state", "99999999999999999999"},
       "--state: '99999999999999999999' is not a whole"},
      {{"simulate", store, "-o", out, "--state", "18446744073709551616"}, "--state: '18446744073709551616'"},
      {{"simulate", store, "-o", out, "--states", "100001"},
       "--states: '100001' is not a whole number from 1 to"},
      {{"simulate", store, "-o", out, "--states", "99999999999999999999"}, "--states: '9999"},
      {{"plan", store, "-o", out, "--states", ""}, "--states: '' is not a whole number from 0 to 10000"},
      {{"new", "thesi", out}, "'thesi'; did you mean 'thesis'?"},
      {{"new", "thesis"}, "DIR is required"},
      {{"simulate", store}, "error: --output is required"},
      {{"simulate", path("none.json")}, "none.json: does not exist, and --output is required"},
      {{"plan", path("none.json")}, "none.json: does not exist, and --output is required"},
      {{"batch", path("none.txt")}, "none.txt: does not exist, and --output is required"},
      {{"diff", path("none")}, "none: does not exist, and PLAN2 is required"},
      {{"simulate", store, "-o"}, "--output: PATH is missing"},
      {{"simulate", store, "-o", out, "--samples", "0"}, "--samples"},
      {{"simulate", store, "-o", out, "--samples", "1e99"}, "--samples"},
      {{"simulate", store, "-o", out, "--estimator", "reuse", "--max-bounces", "3"}, "--max-bounces"},
      {{"simulate", store, "-o", out, "--estimator", "reuse", "--direct", "sampled"}, "--direct"},
      {{"simulate", store, "-o", out, "--strategy", "bdpt"}, "--strategy"},
      {{"simulate", store, "-o", out, "--max-bounces", "-1"}, "--max-bounces"},
      {{"simulate", store, "-o", out, "--by-bounce"}, "--max-bounces"},
      {{"plan", store, "-o", out, "--by-bounce", "--max-bounces", "3"}, "--by-bounce"},
      {{"plan", store, "-o", out, "--by-length", "1"}, "--by-length"},
      {{"simulate", store, "-o", out, "--lengths", "3"}, "--by-length"},
      {{"simulate", store, "-o", out, "--by-length", "0"}, "--by-length"},
      {{"simulate", store, "-o", out, "--by-length", "1", "--estimator", "reuse"}, "--by-length"},
      {{"simulate", store, "-o", out, "--by-length", "1", "--direct", "exact"}, "--direct"},
      {{"simulate", store, "-o", out, "--by-length", "1", "--strategy", "particle"}, "--strategy"},
      {{"place", matrix, "--threshold", "0"}, "--threshold: '0'"},
      {{"place", matrix, "--threshold", "inf"}, "--threshold"},
      {{"place", matrix, "--threshold", "2", "--time-limit", "0"}, "--time-limit"},
      {{"place", matrix, "--threshold", "2", "--share", "-1"}, "--share"},
      {{"place", matrix, "--threshold", "2", "--model", "coop"}, "--model"},
      {{"place", matrix, "--threshold", "2", "--at-most", "99999999999999999999999"},
       "--at-most: '99999999999999999999999'"},
      {{"place", matrix, "--threshold", "2", "--backend", "cplex"}, "--backend"},
      {{"place", matrix, "--threshold", "2", "--weighted", "--lexicographic"}, "excludes"},
      {{"plan", store, "-o", out, "--relative-error", "0"}, "--relative-error"},
      {{"plan", store, "-o", out, "--relative-error", "0.1", "--samples", "100"}, "excludes"},
      {{"plan", store, "-o", out, "--above", "0.1", "--samples", "640"}, "--above"},
      {{"plan", store, "-o", out, "--above", "0.1"}, "--above"},
      {{"plan", path("none.json"), "-o", out, "--confidence", "99"}, "none.json"},
      {{"plan", store, "-o", out, "--confidence", "1"}, "--confidence: '1' is not a share from 0.5 to"},
      {{"plan", store, "-o", out, "--time", "-1"}, "--time"},
      {{"plan", store, "-o", out, "--memory", "4X"}, "--memory: '4X' is not a size such as 4G or 500M"},
      {{"plan", store, "-o", out, "--checkpoint-interval", "-1"}, "--checkpoint-interval"},
      {{"export", matrix, "-o", path("model.xml")}, "model.xml: "},
      {{"export", matrix, "-o", path("model")}, "model: "},
      {{"export", path("signal.h5"), "-o", path("a.csv"), "--what", "variance"}, "--what"},
  };
  for (const auto& [arguments, message] : cases) test::expect_refused(folder, arguments, {message});
}

}  // namespace
}  // namespace shelfbeam
