#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/signal/hdf5/signal_file.hpp"

#include "system/app/program.hpp"

namespace shelfbeam {
namespace {

using test::contents;
using test::expect_silent;
using test::Json;
using test::names;
using test::small_store;
using test::TempFolder;

const std::vector<std::string> of_a_plan = {"labels.csv", "placement.csv", "placement.json",  "report.html",
                                            "signal.h5",  "store.json",    "verification.csv"};

class Workflow : public testing::Test {
 protected:
  Workflow() { folder.write("store.json", small_store().dump()); }
  std::string path(const std::string& name) const { return (folder / name).string(); }
  std::string bytes(const std::string& name) const { return read_file(folder / name); }
  Json json(const std::string& name) const { return Json::parse(bytes(name)); }
  TempFolder folder;
};
using WorkflowSlow = Workflow;

TEST_F(Workflow, NewThenInspect) {
  for (const char* name : {"thesis", "grocery", "chiller", "supermarket", "hypermarket"}) {
    const std::string out = expect_silent({"new", name, path(name)});
    EXPECT_NE(out.find("shelfbeam plan " + path(name) + "/store.json -o " + path(name) + "/plan"),
              std::string::npos);
    EXPECT_TRUE(contents(folder / name) ==
                contents(std::filesystem::path(SHELFBEAM_SOURCE_DIR) / "examples" / name));
    const std::string text = expect_silent({"inspect", path(name) + "/store.json", "-o", path("plan.svg")});
    EXPECT_NE(text.find("reflectance"), std::string::npos);
    EXPECT_TRUE(bytes("plan.svg").starts_with("<?xml"));
  }
  const Json chiller = Json::parse(expect_silent({"inspect", path("chiller/store.json"), "--json"}));
  EXPECT_EQ(chiller["transceiver_types"]["ring"]["file"], "batwing.ies");
  EXPECT_FALSE(chiller["not_simulated"].empty());
  EXPECT_TRUE(chiller["warnings"].empty());
  const Json thesis = Json::parse(expect_silent({"inspect", path("thesis/store.json"), "--json"}));
  EXPECT_EQ(thesis["labels"], 390);
  EXPECT_EQ(thesis["transceivers"], 320);
  EXPECT_EQ(thesis["upper"], Json({20.0, 16.0, 4.0}));
}

// Layers and mean are written in single precision: nine of them add up to 1e-6. The control leaves one out.
TEST_F(Workflow, AMatrixForEachNumberOfBounces) {
  expect_silent({"simulate", path("store.json"), "-o", path("signal.h5"), "--samples", "640", "--max-bounces",
                 "8", "--by-bounce"});
  const SignalMatrix matrix = read_signal_file(folder / "signal.h5");
  ASSERT_EQ(matrix.by_bounce.size(), 9u);
  EXPECT_EQ(matrix.by_bounce[0].mean, matrix.direct);
  std::vector<double> sum(matrix.mean.size());
  for (const SignalLayer& layer : matrix.by_bounce)
    for (std::size_t e = 0; e < sum.size(); ++e) sum[e] += layer.mean[e];
  double largest = 0, without_last = 0;
  for (std::size_t e = 0; e < sum.size(); ++e) {
    largest = std::max(largest, std::abs(sum[e] / matrix.mean[e] - 1));
    without_last =
        std::max(without_last, std::abs((sum[e] - matrix.by_bounce[8].mean[e]) / matrix.mean[e] - 1));
  }
  EXPECT_LT(largest, 1e-6);
  EXPECT_GT(without_last, 1e-6);
}

// Every strategy gives a matrix of the same sum: 20,000 samples, a relative standard error of the sum below
// 1 %, of which 4 are allowed. The control is a matrix without the paths of more than one bounce.
TEST_F(Workflow, StrategiesAgree) {
  Json store = Json::parse(bytes("store.json"));
  store["transceiver_types"]["ceiling"]["radius"] = 0.2;
  folder.write("discs.json", store.dump());
  const auto sum = [&](const std::vector<std::string>& options) {
    std::vector<std::string> command{"simulate",        path("discs.json"), "-o",
                                     path("signal.h5"), "--samples",        "20000"};
    command.insert(command.end(), options.begin(), options.end());
    expect_silent(command);
    double total = 0;
    for (const float value : read_signal_file(folder / "signal.h5").mean) total += value;
    return total;
  };
  const double mis = sum({});
  for (const std::vector<std::string>& options : {std::vector<std::string>{"--strategy", "walk"},
                                                  {"--strategy", "nee", "--direct", "exact"},
                                                  {"--strategy", "mis", "--heuristic", "power"},
                                                  {"--strategy", "particle"}})
    EXPECT_NEAR(sum(options) / mis, 1, 0.04) << options[1];
  EXPECT_LT(sum({"--max-bounces", "1"}) / mis, 0.96);
}

// Three grids of one extent with other axes: options of the same 12 points.
TEST_F(Workflow, OffersSeveralTiltsAtAMountingPoint) {
  Json store = small_store();
  Json grid = store["transceivers"]["grids"][0];
  for (const double lean : {0.4, -0.4}) {
    grid["axis"] = {0, lean, -1};
    store["transceivers"]["grids"].push_back(grid);
  }
  folder.write("tilts.json", store.dump());
  EXPECT_NE(
      expect_silent({"inspect", path("tilts.json")}).find("36 candidate transceivers at 12 mounting points"),
      std::string::npos);
  EXPECT_EQ(Json::parse(expect_silent({"inspect", path("tilts.json"), "--json"}))["mounting_points"], 12);
  const std::string text = expect_silent(
      {"plan", path("tilts.json"), "-o", path("plan"), "--samples", "2000", "--direct", "exact"});
  EXPECT_NE(text.find("from 36 candidates at 12 mounting points"), std::string::npos) << text;
  EXPECT_NE(bytes("plan/report.html").find("of 36 candidates at 12 mounting points"), std::string::npos);

  // Whichever grid a unit is of, a point is its ix and iy.
  std::set<std::string> points;
  const Json selected = json("plan/placement.json")["selected"];
  for (const Json& id : selected) {
    points.insert(id.get<std::string>().substr(2));
    EXPECT_NE(bytes("plan/placement.csv").find(id.get<std::string>() + ","), std::string::npos);
  }
  EXPECT_EQ(points.size(), selected.size());
  expect_silent({"report", path("plan")});
  expect_silent({"export", path("plan/signal.h5"), "-o", path("model.lp")});
  std::size_t rows = 0;
  for (std::size_t at = 0; (at = bytes("model.lp").find(" mount_", at)) != std::string::npos; ++at) ++rows;
  EXPECT_EQ(rows, 12u);
}

// Profiles, meshes, doors and several ways to aim, from the template to the report. Six units is what each of
// three seeds gave at the default number of samples.
TEST_F(WorkflowSlow, PlansTheChiller) {
  expect_silent({"new", "chiller", path("chiller")});
  const std::string text =
      expect_silent({"plan", path("chiller/store.json"), "-o", path("plan"), "--no-certificate"});
  EXPECT_NE(text.find("fewer cannot, proven"), std::string::npos) << text;
  const Json placement = json("plan/placement.json");
  EXPECT_EQ(placement["status"], "optimal");
  EXPECT_NEAR(placement["count"], 6, 1);
  EXPECT_NE(placement["selected"].dump().find("over-till"), std::string::npos);
  EXPECT_FALSE(placement.contains("certificate"));
  std::set<std::string> files(of_a_plan.begin(), of_a_plan.end());
  files.erase("verification.csv");
  EXPECT_EQ(names(folder / "plan"), files);
}

TEST_F(Workflow, SimulateThenPlaceThenExport) {
  expect_silent(
      {"simulate", path("store.json"), "-o", path("signal.h5"), "--samples", "2000", "--direct", "exact"});
  const SignalMatrix matrix = read_signal_file(folder / "signal.h5");
  ASSERT_EQ(matrix.rows(), 17u);
  ASSERT_EQ(matrix.columns(), 12u);
  EXPECT_GE(matrix.labels[0].samples, 2000u);
  EXPECT_EQ(matrix.labels[0].batches, 32u);

  const std::string text = expect_silent({"place", path("signal.h5"), "-o", path("placement.json")});
  EXPECT_NE(text.find("fewer cannot, proven"), std::string::npos) << text;
  const Json placement = json("placement.json");
  for (const char* key : {"format", "model", "objective", "selected", "count", "count_lower_bound",
                          "objective_value", "lower_bound", "status", "solver", "seconds", "unreachable"})
    EXPECT_TRUE(placement.contains(key)) << key;
  EXPECT_EQ(placement["status"], "optimal");
  EXPECT_GE(placement["count"], 2);
  EXPECT_EQ(placement["selected"].size(), placement["count"]);
  EXPECT_EQ(placement["count_lower_bound"], placement["count"]);

  for (const char* name : {"model.mps", "model.lp", "mean.csv", "mean.npy"})
    EXPECT_EQ(expect_silent({"export", path("signal.h5"), "-o", path(name)}), path(name) + "\n");
  EXPECT_NE(bytes("model.mps").find("ENDATA"), std::string::npos);
  EXPECT_NE(bytes("model.lp").find("End"), std::string::npos);
  EXPECT_TRUE(bytes("mean.npy").starts_with("\x93NUMPY"));
  EXPECT_TRUE(bytes("mean.csv").starts_with("label,G1-1-1,"));
  expect_silent({"export", path("signal.h5"), "-o", path("direct.csv"), "--what", "direct"});
  expect_silent({"export", path("signal.h5"), "-o", path("error.csv"), "--what", "standard-error"});
  EXPECT_EQ((std::set{bytes("mean.csv"), bytes("direct.csv"), bytes("error.csv")}).size(), 3u);

  // The matrix placed from its CSV and its NPY form asks for the same units; NPY knows no ids.
  expect_silent({"place", path("mean.csv"), "--threshold", "0.03", "-o", path("from_csv.json")});
  EXPECT_EQ(json("from_csv.json")["selected"], placement["selected"]);
  expect_silent({"place", path("mean.npy"), "--threshold", "0.03", "-o", path("from_npy.json")});
  EXPECT_EQ(json("from_npy.json")["count"], placement["count"]);
}

TEST_F(Workflow, EveryQuestionIsAnswered) {
  expect_silent(
      {"simulate", path("store.json"), "-o", path("signal.h5"), "--samples", "2000", "--direct", "exact"});
  std::set<std::string> answers;
  for (const char* model : {"cooperative", "non-cooperative"})
    for (const char* objective : {"count", "links", "effective-links", "signal"})
      for (const char* combination : {"--lexicographic", "--weighted"})
        for (const char* solver : {"mip", "greedy"}) {
          expect_silent({"place", path("signal.h5"), "-o", path("p.json"), "--model", model, "--objective",
                         objective, combination, "--solver", solver});
          const Json placement = json("p.json");
          EXPECT_EQ(placement["model"], model);
          EXPECT_EQ(placement["objective"], objective);
          EXPECT_EQ(placement["status"], std::string(solver) == "mip" ? "optimal" : "feasible");
        }
}

TEST_F(Workflow, PlanLeavesEveryFileOfTheContract) {
  const std::string out =
      expect_silent({"plan", path("store.json"), "-o", path("plan"), "--samples", "2000"});
  EXPECT_NE(out.find("report: " + path("plan/report.html")), std::string::npos);
  EXPECT_EQ(names(folder / "plan"), std::set<std::string>(of_a_plan.begin(), of_a_plan.end()));
  EXPECT_TRUE(bytes("plan/report.html").starts_with("<!DOCTYPE html>"));
  EXPECT_TRUE(bytes("plan/labels.csv").starts_with("id,x,y,z,nx,ny,nz,type,"));
  EXPECT_TRUE(bytes("plan/placement.csv").starts_with("id,x,y,z,ax,ay,az,roll_deg,type,"));

  // It is what simulate and place give for the same seed.
  expect_silent({"simulate", path("store.json"), "-o", path("signal.h5"), "--samples", "2000"});
  EXPECT_TRUE(bytes("signal.h5") == bytes("plan/signal.h5"));
  expect_silent({"place", path("signal.h5"), "-o", path("placement.json")});
  EXPECT_EQ(json("placement.json")["selected"], json("plan/placement.json")["selected"]);
}

TEST_F(Workflow, PlanOfItsOwnStoreIsTheSamePlan) {
  expect_silent({"plan", path("store.json"), "-o", path("plan"), "--samples", "2000"});
  auto first = contents(folder / "plan");
  expect_silent({"plan", path("plan/store.json"), "-o", path("again"), "--samples", "2000"});
  expect_silent({"plan", path("plan/store.json"), "-o", path("plan"), "--samples", "2000"});
  for (const char* name : {"signal.h5", "store.json", "labels.csv", "placement.csv"}) {
    EXPECT_TRUE(contents(folder / "again")[name] == first[name]) << name;
    EXPECT_TRUE(contents(folder / "plan")[name] == first[name]) << name;
  }
}

TEST_F(Workflow, ReportIsRebuilt) {
  expect_silent({"plan", path("store.json"), "-o", path("plan"), "--samples", "2000"});
  const auto before = contents(folder / "plan");
  for (const char* name : {"report.html", "labels.csv", "placement.csv"})
    std::filesystem::remove(folder / "plan" / name);
  EXPECT_EQ(expect_silent({"report", path("plan")}), path("plan/report.html") + "\n");
  EXPECT_TRUE(contents(folder / "plan") == before);
}

TEST_F(Workflow, ListsOfAPlanCanBeReadBack) {
  expect_silent({"plan", path("store.json"), "-o", path("plan"), "--samples", "2000"});
  Json store = small_store();
  store["fixtures"][0].erase("labels");
  store["labels"] = {{"csv", "plan/labels.csv"}};
  store["transceivers"] = {{"list", {{"csv", "plan/placement.csv"}}}};
  folder.write("again.json", store.dump());
  const Json summary = Json::parse(expect_silent({"inspect", path("again.json"), "--json"}));
  EXPECT_EQ(summary["labels"], 17);
  EXPECT_EQ(summary["transceivers"], json("plan/placement.json")["count"]);
}

TEST_F(Workflow, NamesMayHaveBlanksAndOtherLetters) {
  const std::string odd = "Müller & Söhne 'Größe \"7\" 名前";
  Json store = small_store();
  store["name"] = odd;
  store["fixtures"][0]["id"] = odd;
  store["labels"][0]["id"] = "<b>, \"door\"; 'x'";
  folder.write(odd + "/store of.json", store.dump());
  expect_silent({"plan", path(odd + "/store of.json"), "-o", path(odd + "/der Plan"), "--samples", "2000"});
  EXPECT_EQ(names(folder / odd / "der Plan"), std::set<std::string>(of_a_plan.begin(), of_a_plan.end()));
  expect_silent({"report", path(odd + "/der Plan")});
  const Json summary = Json::parse(expect_silent(
      {"simulate", path(odd + "/store of.json"), "-o", path(odd + "/s.h5"), "--samples", "64", "--json"}));
  EXPECT_EQ(summary["signal"], path(odd + "/s.h5"));
  expect_silent({"export", path(odd + "/s.h5"), "-o", path(odd + "/s.csv")});
  expect_silent({"place", path(odd + "/s.csv"), "--threshold", "1e-6"});
}

TEST_F(Workflow, ThreadsDoNotChangeASignalAndSeedsDo) {
  const auto simulate = [&](const std::string& threads, const std::string& seed, const std::string& direct) {
    expect_silent({"simulate", path("store.json"), "-o", path("signal.h5"), "--samples", "1000", "--threads",
                   threads, "--seed", seed, "--direct", direct, "--quiet"});
    return bytes("signal.h5");
  };
  for (const char* direct : {"sampled", "exact"}) {
    const std::string one = simulate("1", "7", direct);
    EXPECT_TRUE(simulate("2", "7", direct) == one);
    EXPECT_TRUE(simulate("5", "7", direct) == one);
    EXPECT_TRUE(simulate("0", "7", direct) == one);
    EXPECT_FALSE(simulate("1", "8", direct) == one);
  }
}

TEST_F(Workflow, OnePlacementForSeveralScenarios) {
  folder.write("day.csv", "label,A,B,C\nL1,2,0,1\nL2,0,4,1\n");
  folder.write("night.csv", "label,C,B,A\nL1,0,3,0\n");
  folder.write("pairs.csv", "a,b\nA,B\n");
  const std::string text = expect_silent({"place", path("day.csv"), path("night.csv"), "--threshold", "1"});
  EXPECT_NE(text.find("2 transceivers reach all 3 labels"), std::string::npos) << text;
  EXPECT_NE(text.find("day: 2 labels, the weakest (day:L1) gets 2 of its requirement"), std::string::npos)
      << text;
  EXPECT_NE(text.find("night: 1 label, the weakest (night:L1) gets 3 of"), std::string::npos) << text;
  const auto json = test::Json::parse(expect_silent({"place", path("day.csv"), "--forbid", path("pairs.csv"),
                                                     path("night.csv"), "--threshold", "1", "--json"}));
  EXPECT_EQ(json["selected"], (test::Json{"B", "C"}));
  EXPECT_EQ(json["scenarios"][1]["name"], "night");
  const std::string survives =
      expect_silent({"place", path("day.csv"), "--threshold", "1", "--survive-failure"});
  EXPECT_NE(survives.find("3 transceivers reach all 2 labels (cooperative, whichever unit fails)"),
            std::string::npos)
      << survives;
}

TEST_F(Workflow, TellsWhatFewerTransceiversReach) {
  folder.write("m.csv", "label,A,B,C\nL1,1,0,1\nL2,1,0,1\nL3,1,0,0\nL4,0,1,1\nL5,0,1,1\nL6,0,1,0\n");
  std::string text = expect_silent({"place", path("m.csv"), "--threshold", "1", "--at-most", "1"});
  EXPECT_NE(
      text.find(
          "1 transceiver reaches 4 of 6 labels, 66.7 % (cooperative); no single transceiver reaches more, "
          "proven.\n  chosen: C\n  optimal: reached 4, upper bound 4, gap 0.0 %; "),
      std::string::npos)
      << text;
  const auto reach = test::Json::parse(expect_silent(
      {"place", path("m.csv"), "--threshold", "1", "--at-most", "1", "--json", "-o", path("reach.json")}));
  EXPECT_EQ(reach["missed"], (test::Json{"L3", "L6"}));
  EXPECT_EQ(reach["reached_upper_bound"], 4);
  EXPECT_TRUE(test::fs::exists(folder / "reach.json"));
  text = expect_silent({"place", path("m.csv"), "--threshold", "1", "--curve"});
  EXPECT_NE(text.find("      1                     66.7 %    66.7 %\n"), std::string::npos) << text;
  const auto whole =
      test::Json::parse(expect_silent({"place", path("m.csv"), "--threshold", "1", "--curve", "--json"}));
  EXPECT_EQ(whole["curve"].size(), 2U);
  EXPECT_EQ(whole["curve_complete"], true);
  EXPECT_EQ(whole["curve"][0]["at_most"], 4);
  EXPECT_EQ(whole["critical"][0]["count"], 3);
  for (const char* many : {"4294967296", "18446744073709551615"}) {
    text = expect_silent({"place", path("m.csv"), "--threshold", "1", "--at-most", many});
    EXPECT_EQ(text.find("2 transceivers reach all 6 labels (cooperative).\n"), 0U) << text;
  }
  // The curve knows a better placement than the greedy one, and that nothing is better still.
  const auto greedy = test::Json::parse(
      expect_silent({"place", path("m.csv"), "--threshold", "1", "--solver", "greedy", "--json"}));
  EXPECT_EQ(greedy["count"], 3);
  EXPECT_EQ(greedy["count_lower_bound"], 1);
  text = expect_silent({"place", path("m.csv"), "--threshold", "1", "--solver", "greedy", "--curve"});
  EXPECT_EQ(text.find("2 transceivers reach all 6 labels (cooperative); fewer cannot, proven.\n"), 0U)
      << text;
  text = expect_silent({"place", path("m.csv"), "--threshold", "2", "--curve"}, 1);
  EXPECT_NE(text.find("'--at-most K'"), std::string::npos) << text;
}

TEST_F(Workflow, PlansTellCurveAndSensitivity) {
  const std::vector<std::string> plan{"plan", path("store.json"), "-o", path("plan"), "--samples",
                                      "640",  "--no-certificate"};
  auto asked = plan;
  asked.insert(asked.end(), {"--curve", "--sensitivity", "--reflectance-error", "0.25"});
  const std::string text = expect_silent(asked);
  EXPECT_NE(text.find("  units   labels reached: at least   at most\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\nsensitivity: "), std::string::npos) << text;
  const Json placement = json("plan/placement.json");
  EXPECT_EQ(placement["curve"].size(), placement["count"]);
  EXPECT_EQ(placement["curve_complete"], true);
  const Json& sensitivity = placement["sensitivity"];
  EXPECT_EQ(sensitivity["assumed_error"], 0.25);
  for (const Json& material : sensitivity["materials"])
    EXPECT_DOUBLE_EQ(material["range"][0].get<double>(), 0.75 * material["reflectance"].get<double>());
  EXPECT_LT(sensitivity["low"]["smallest_margin"], sensitivity["high"]["smallest_margin"]);
  const std::string page = bytes("plan/report.html");
  EXPECT_NE(page.find("<section id=\"sensitivity\">"), std::string::npos);
  EXPECT_NE(page.find("<section id=\"curve\">"), std::string::npos);
  expect_silent({"report", path("plan")});
  EXPECT_TRUE(bytes("plan/report.html") == page) << "rebuilt from what lies in the folder";
  expect_silent(plan);
  EXPECT_FALSE(json("plan/placement.json").contains("sensitivity"));
  EXPECT_FALSE(json("plan/placement.json").contains("curve"));
  EXPECT_EQ(bytes("plan/report.html").find("<section id=\"curve\">"), std::string::npos);
}

TEST_F(Workflow, AnswersSayWhatTheyRestOn) {
  folder.write("m.csv", "label,A,B,C\nL1,1,0,1\nL2,1,0,1\nL3,1,0,0\nL4,0,1,1\nL5,0,1,1\nL6,0,1,0\n");
  std::vector<std::string> ask = {"place", path("m.csv"), "--threshold", "1"};
  const auto text = [&](const std::vector<std::string>& more, int code = 0) {
    std::vector<std::string> all = ask;
    all.insert(all.end(), more.begin(), more.end());
    return expect_silent(all, code);
  };
  const auto expect = [](const std::string& out, const std::vector<std::string>& parts) {
    for (const std::string& part : parts) EXPECT_NE(out.find(part), std::string::npos) << part << '\n' << out;
  };
  expect(text({}),
         {"\n  labels that hang on one unit: A 3, B 3\n", "\n  optimal: value 2, lower bound 2, gap 0.0 %; ",
          ", solver search\n", "\n  bound: exhaustive search, its log checked; of equal"});
  expect(text({"--solver", "search"}), {"optimal", "solver search\n"});
  expect(text({"--solver", "greedy"}),
         {"labels (cooperative); at least 1 transceiver is needed.\n",
          "\n  feasible: value 3, lower bound 1, gap 66.7 %; ", "solver greedy\n"});
  const std::string lost =
      "L3: at most 0, needs 1 (light arrives from one place only, and the unit there may fail)";
  expect(text({"--survive-failure"}, 1), {"2 cannot be reached even by all candidates together when", lost,
                                          "\n  infeasible; ", "solver not needed\n"});
  expect(text({"--survive-failure", "--model", "non-cooperative"}, 1),
         {"whichever unit fails: 2 cannot be reached by two units at once.\n", lost});
  folder.write("pairs.csv", "a,b\nA,B\n");
  expect(text({"--forbid", path("pairs.csv")}, 1),
         {"because some pairs must not be chosen together (proven by",
          "\n  1 pair of candidates is kept apart: some pairs must not be chosen together\n"});
  folder.write("dark.csv", "label,A\nL1,1\nL2,0\n");
  ask[1] = path("dark.csv");
  expect(text({}, 1), {"L2: at most 0, needs 1 (no light arrives at all: is it inside something"});
}

TEST_F(Workflow, ScenariosAreToldApartByTheirFolders) {
  for (const char* store : {"full", "empty"})
    expect_silent({"plan", path("store.json"), "-o", path(store), "--samples", "320"});
  const auto placed = [&](const std::vector<std::string>& files) {
    std::vector<std::string> arguments = {"place", "--json"};
    for (const std::string& file : files) arguments.push_back(path(file));
    return test::Json::parse(expect_silent(arguments));
  };
  test::Json answer = placed({"full/signal.h5", "empty/signal.h5"});
  EXPECT_EQ(answer["scenarios"][0]["name"], "full/signal");
  EXPECT_EQ(answer["scenarios"][1]["name"], "empty/signal");
  EXPECT_TRUE(answer["critical"][0]["labels"][0].get<std::string>().starts_with("full/signal:")) << answer;
  // As little as is needed, and the ending where nothing else differs.
  std::filesystem::copy_file(folder / "full/signal.h5", folder / "night.h5");
  std::filesystem::copy_file(folder / "full/signal.h5", folder / "night.hdf5");
  std::filesystem::copy_file(folder / "full/signal.h5", folder / "signal.h5");
  answer = placed({"full/signal.h5", "empty/signal.h5", "night.h5"});
  EXPECT_EQ(answer["scenarios"][2]["name"], "night");
  answer = placed({"night.h5", "night.hdf5"});
  EXPECT_EQ(answer["scenarios"][0]["name"], "night.h5");
  EXPECT_EQ(answer["scenarios"][1]["name"], "night.hdf5");
  test::expect_refused(folder, {"place", path("night.h5"), path("full/../night.h5")},
                       {"night.h5", "scenario"});
}

TEST_F(Workflow, AFileHoldsOneObjective) {
  folder.write("m.csv", "label,A,B\nL1,1,1\n");
  const std::vector<std::string> ask = {"export", path("m.csv"), "-o",    path("m.lp"), "--threshold",
                                        "1",      "--objective", "links", "--model",    "non-cooperative"};
  test::expect_refused(folder, ask, {"--objective links", "--weighted"});
  std::vector<std::string> weighted = ask;
  weighted.push_back("--weighted");
  expect_silent(weighted);
  EXPECT_NE(bytes("m.lp").find("2 "), std::string::npos) << "a unit and its link";
}

}  // namespace
}  // namespace shelfbeam
