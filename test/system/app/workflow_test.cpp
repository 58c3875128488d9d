#include <algorithm>
#include <cmath>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

#include "system/app/program.hpp"

namespace shelfbeam {
namespace {

using test::contents;
using test::expect_silent;
using test::Json;
using test::names;
using test::small_store;

const std::vector<std::string> of_a_plan = {
    "bill.csv",    "labels.csv", "mounting.csv", "mounting.dxf", "placement.csv",   "placement.json",
    "report.html", "run.json",   "signal.h5",    "store.json",   "verification.csv"};

class Workflow : public test::ProgramTest {
 protected:
  Workflow() {
    folder.write("m.csv", "label,A,B,C\nL1,1,0,1\nL2,1,0,1\nL3,1,0,0\nL4,0,1,1\nL5,0,1,1\nL6,0,1,0\n");
    folder.write("dark.csv", "label,A\nL1,1\nL2,0\n");
    folder.write("pairs.csv", "a,b\nA,B\n");
    folder.write("day.csv", "label,A,B,C\nL1,2,0,1\nL2,0,4,1\n");
    folder.write("night.csv", "label,C,B,A\nL1,0,3,0\n");
  }
};
using WorkflowSlow = Workflow;

TEST_F(Workflow, NewThenInspect) {
  for (const auto& example : std::filesystem::directory_iterator(SHELFBEAM_SOURCE_DIR "/examples")) {
    const std::string name = example.path().filename();
    const std::string out = expect_silent({"new", name, path(name)});
    EXPECT_NE(out.find("shelfbeam plan " + path(name) + "/store.json -o " + path(name) + "/plan"),
              std::string::npos);
    EXPECT_TRUE(contents(folder / name) == contents(example.path()));
    const std::string text = expect_silent({"inspect", path(name) + "/store.json", "-o", path("plan.svg")});
    EXPECT_NE(text.find("reflectance"), std::string::npos);
    EXPECT_TRUE(bytes("plan.svg").starts_with("<?xml"));
  }
  const Json chiller = Json::parse(told("inspect @chiller/store.json --json"));
  EXPECT_EQ(chiller["transceiver_types"]["ring"]["file"], "batwing.ies");
  EXPECT_FALSE(chiller["not_simulated"].empty());
  EXPECT_TRUE(chiller["warnings"].empty());
  const Json thesis = Json::parse(told("inspect @thesis/store.json --json"));
  EXPECT_EQ(thesis["labels"], 390);
  EXPECT_EQ(thesis["transceivers"], 320);
  EXPECT_EQ(thesis["upper"], Json({20.0, 16.0, 4.0}));
}

// Layers and mean are written in single precision, and the sum of nine layers is exact to 1e-6. The control
// omits one layer.
TEST_F(Workflow, WritesAMatrixForEachNumberOfBounces) {
  told("simulate @store.json -o @signal.h5 --samples 640 --max-bounces 8 --by-bounce");
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

// Every strategy gives a matrix with the same sum: with 20,000 samples the relative standard error of the sum
// is below 1 %, and 4 of them are allowed. The control is a matrix without paths of more than one bounce.
TEST_F(Workflow, StrategiesAgree) {
  Json store = small_store();
  store["transceiver_types"]["ceiling"]["radius"] = 0.2;
  folder.write("discs.json", store.dump());
  const auto sum = [&](const std::string& options) {
    told("simulate @discs.json -o @signal.h5 --samples 20000 " + options);
    double total = 0;
    for (const float value : read_signal_file(folder / "signal.h5").mean) total += value;
    return total;
  };
  const double mis = sum("");
  for (const char* options : {"--strategy walk", "--strategy nee --direct exact",
                              "--strategy mis --heuristic power", "--strategy particle"})
    EXPECT_NEAR(sum(options) / mis, 1, 0.04) << options;
  EXPECT_LT(sum("--max-bounces 1") / mis, 0.96);
}

// Three grids of one extent with different axes: options of the same 12 mounting points.
TEST_F(Workflow, OffersSeveralTiltsAtAMountingPoint) {
  Json store = small_store();
  Json grid = store["transceivers"]["grids"][0];
  for (const double lean : {0.4, -0.4}) {
    grid["axis"] = {0, lean, -1};
    store["transceivers"]["grids"].push_back(grid);
  }
  folder.write("tilts.json", store.dump());
  EXPECT_EQ(Json::parse(told("inspect @tilts.json --json"))["mounting_points"], 12);
  const std::string text = told("plan @tilts.json -o @plan --samples 2000 --direct exact");
  EXPECT_NE(text.find("from 36 candidates at 12 mounting points"), std::string::npos) << text;
  EXPECT_NE(bytes("plan/report.html").find("<dt>Mounting points</dt><dd>12</dd>"), std::string::npos);

  // In every grid, ix and iy of a unit name its mounting point.
  std::set<std::string> points;
  const Json selected = json("plan/placement.json")["selected"];
  for (const Json& id : selected) {
    points.insert(id.get<std::string>().substr(2));
    EXPECT_NE(bytes("plan/placement.csv").find(id.get<std::string>() + ","), std::string::npos);
  }
  EXPECT_EQ(points.size(), selected.size());
  told("report @plan");
  told("export @plan/signal.h5 -o @model.lp");
  std::size_t rows = 0;
  for (std::size_t at = 0; (at = bytes("model.lp").find(" mount_", at)) != std::string::npos; ++at) ++rows;
  EXPECT_EQ(rows, 12u);
}

// Profiles, meshes, doors and several orientations, from the template to the report. With 1,000 samples,
// two of three seeds gave six units, and one gave five.
TEST_F(WorkflowSlow, PlansTheChiller) {
  told("new chiller @chiller");
  told("plan @chiller/store.json -o @plan --samples 1000 --no-certificate");
  const Json placement = json("plan/placement.json");
  EXPECT_EQ(placement["status"], "optimal");
  EXPECT_EQ(placement["count_lower_bound"], placement["count"]);
  EXPECT_NEAR(placement["count"], 6, 1);
  EXPECT_NE(placement["selected"].dump().find("over-till"), std::string::npos);
  EXPECT_FALSE(placement.contains("certificate"));
  std::set<std::string> files(of_a_plan.begin(), of_a_plan.end());
  files.erase("verification.csv");
  EXPECT_EQ(names(folder / "plan"), files);
}

TEST_F(Workflow, SimulateThenPlaceThenExport) {
  told("simulate @store.json -o @signal.h5 --samples 2000 --direct exact");
  const SignalMatrix matrix = read_signal_file(folder / "signal.h5");
  ASSERT_EQ(matrix.rows(), 17u);
  ASSERT_EQ(matrix.columns(), 12u);
  EXPECT_GE(matrix.labels[0].samples, 2000u);
  EXPECT_EQ(matrix.labels[0].batches, 32u);

  told("place @signal.h5 -o @placement.json");
  const Json placement = json("placement.json");
  EXPECT_EQ(placement["status"], "optimal");
  EXPECT_GE(placement["count"], 2);
  EXPECT_EQ(placement["selected"].size(), placement["count"]);
  EXPECT_EQ(placement["count_lower_bound"], placement["count"]);

  for (const std::string name : {"model.mps", "model.lp", "mean.csv", "mean.npy"})
    EXPECT_EQ(told("export @signal.h5 -o @" + name), path(name) + "\n");
  EXPECT_NE(bytes("model.mps").find("ENDATA"), std::string::npos);
  EXPECT_NE(bytes("model.lp").find("End"), std::string::npos);
  EXPECT_TRUE(bytes("mean.npy").starts_with("\x93NUMPY"));
  EXPECT_TRUE(bytes("mean.csv").starts_with("label,G1-1-1,"));
  told("export @signal.h5 -o @direct.csv --what direct");
  told("export @signal.h5 -o @error.csv --what standard-error");
  EXPECT_EQ((std::set{bytes("mean.csv"), bytes("direct.csv"), bytes("error.csv")}).size(), 3u);

  // The matrix placed from its CSV and its NPY form has the same count; NPY has no ids.
  told("place @mean.csv --threshold 0.03 -o @from_csv.json");
  EXPECT_EQ(json("from_csv.json")["selected"], placement["selected"]);
  told("place @mean.npy --threshold 0.03 -o @from_npy.json");
  EXPECT_EQ(json("from_npy.json")["count"], placement["count"]);

  // Noise below 0 is written as the 0 that `place` counts it as; it refuses negative signals of other
  // programs.
  SignalMatrix noisy = matrix;
  noisy.mean[noisy.at(1, 0)] = -0.5F * noisy.standard_error[noisy.at(1, 0)];
  ASSERT_LT(noisy.mean[noisy.at(1, 0)], 0);
  write_signal_file(noisy, folder / "noisy.h5");
  told("export @noisy.h5 -o @noisy.csv");
  EXPECT_EQ(read_signal_table(folder / "noisy.csv").entries.size(),
            make_signal_table(noisy, "noisy").entries.size());
}

TEST_F(Workflow, EveryProblemHasAPlacement) {
  told("simulate @store.json -o @signal.h5 --samples 2000 --direct exact");
  for (const std::string model : {"cooperative", "non-cooperative"})
    for (const std::string objective : {"count", "links", "effective-links", "signal"})
      for (const std::string combination : {"lexicographic", "weighted"})
        for (const std::string solver : {"mip", "greedy"}) {
          told(fmt::format("place @signal.h5 -o @p.json --model {} --objective {} --{} --solver {}", model,
                           objective, combination, solver));
          const Json placement = json("p.json");
          EXPECT_EQ(placement["model"], model);
          EXPECT_EQ(placement["objective"], objective);
          EXPECT_EQ(placement["combination"], combination);
          // Multipliers may prove that the greedy placement is optimal.
          if (solver == "mip")
            EXPECT_EQ(placement["status"], "optimal");
          else
            EXPECT_NE(placement["status"], "infeasible");
        }
}

TEST_F(Workflow, PlanLeavesEveryFileOfTheContract) {
  const std::string out = told("plan @store.json -o @plan --samples 2000");
  EXPECT_TRUE(std::regex_search(
      out, std::regex("^[0-9]+ transceivers reach all 17 labels, .* with 99 % confidence\\. This "
                      "[^\n]*\nVerified for assumed "
                      "values\\. [^\n]*\nreport: "
                      "[^\n]*"
                      "/plan/report\\.html\non the simulated signals: (.*\n)+simulation: 17 labels x")))
      << out;
  auto plan = contents(folder / "plan");
  EXPECT_EQ(names(folder / "plan"), std::set<std::string>(of_a_plan.begin(), of_a_plan.end()));
  EXPECT_TRUE(plan["report.html"].starts_with("<!DOCTYPE html>"));
  EXPECT_TRUE(plan["labels.csv"].starts_with("id,x,y,z,nx,ny,nz,type,"));
  EXPECT_TRUE(plan["placement.csv"].starts_with("id,x,y,z,ax,ay,az,roll_deg,type,"));

  // The plan is equal to the results of simulate and place with the same seed.
  told("simulate @store.json -o @signal.h5 --samples 2000");
  EXPECT_TRUE(bytes("signal.h5") == plan["signal.h5"]);
  told("place @signal.h5 -o @placement.json");
  const Json placement = json("plan/placement.json");
  EXPECT_EQ(json("placement.json")["selected"], placement["selected"]);

  // The folder contains the data of the report.
  for (const char* name : {"report.html", "labels.csv", "placement.csv"})
    std::filesystem::remove(folder / "plan" / name);
  EXPECT_EQ(told("report @plan"), path("plan/report.html") + "\n");
  EXPECT_TRUE(contents(folder / "plan") == plan);

  // A plan of the plan's own store is the same plan.
  for (const std::string other : {"again", "plan"}) {
    told("plan @plan/store.json -o @" + other + " --samples 2000 --overwrite");
    for (const char* name : {"signal.h5", "store.json", "labels.csv", "placement.csv"})
      EXPECT_TRUE(contents(folder / other)[name] == plan[name]) << other << name;
  }
}

TEST_F(Workflow, FileNamesMayHaveBlanksAndNonAsciiLetters) {
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
  for (const std::string direct : {"sampled", "exact"}) {
    const auto simulated = [&](const std::string& options) {
      told(fmt::format("simulate @store.json -o @signal.h5 --samples 1000 --quiet --direct {}{}", direct,
                       options));
      return bytes("signal.h5");
    };
    const std::string one = simulated(" --seed 7 --threads 1");
    for (const char* threads : {"2", "5", "0"})
      EXPECT_TRUE(simulated(std::string(" --seed 7 --threads ") + threads) == one) << threads;
    EXPECT_FALSE(simulated(" --seed 8 --threads 1") == one);
  }
}

// `place` prints the sentences of test/data/messages.txt in their lines.
TEST_F(Workflow, PlacePrintsTheDocumentedSentences) {
  const auto expect = [&](const std::string& line, const std::vector<std::string>& parts, int exit_code = 0) {
    const bool has_threshold = line.find("--threshold") != std::string::npos;
    const std::string text = told("place " + line + (has_threshold ? "" : " --threshold 1"), exit_code);
    for (const std::string& part : parts)
      EXPECT_NE(text.find(part), std::string::npos) << line << '\n' << part << '\n' << text;
  };
  expect("@m.csv", {"2 transceivers reach all 6 labels (cooperative); it is proven that 1 is not enough.\n",
                    "\n  chosen: A, B\n", ": A 3, B 3\n", "\n  optimal: value 2, lower bound 2, gap 0.0 %; ",
                    ", solver search\n", "\n  bound: exhaustive search, log checked; among equally good"});
  expect("@m.csv --solver search", {"optimal", "solver search\n"});
  expect("@m.csv --solver greedy", {"labels (cooperative); at least 2 transceivers are needed.\n",
                                    "\n  feasible: value 3, lower bound 2, gap 33.3 %; ", "solver greedy\n"});
  told("place @m.csv --threshold 1 -o @best.json");
  expect("@m.csv --solver greedy --start @best.json",
         {"2 transceivers reach all 6 labels", "\n  chosen: A, B\n"});
  const Json found = Json::parse(told("place @m.csv --threshold 1 --json"));
  EXPECT_EQ(found["steps"][0]["name"], "greedy");
  EXPECT_TRUE(found["steps"][0]["value_before"].is_null());
  EXPECT_EQ(found["steps"][0]["value"], 3);
  EXPECT_EQ(found["steps"].back()["value"], 2);
  // The printed object is a placement file, too; units that it lacks are added if they are pinned.
  folder.write("printed.json", told("place @m.csv --threshold 1 --json"));
  expect("@m.csv --solver greedy --start @printed.json --pin C", {"3 transceivers reach all 6 labels"});
  // The curve contains a better placement than the greedy one, and proves that none is better.
  expect("@m.csv --solver greedy --curve",
         {"2 transceivers reach all 6 labels (cooperative); it is proven that 1 is not enough.\n",
          "      1                     66.6 %    66.7 %\n"});
  expect("@m.csv --threshold 2 --curve", {"'--at-most K'"}, 1);
  expect("@m.csv --at-most 1",
         {"1 transceiver reaches 4 of 6 labels, 66.7 % (cooperative); it is proven that no single "
          "transceiver reaches more.\n  chosen: C\n  optimal: reached 4, upper bound 4, gap 0.0 %; "});
  for (const std::string many : {"4294967296", "18446744073709551615"})
    expect("@m.csv --at-most " + many, {"2 transceivers reach all 6 labels (cooperative).\n"});
  const std::string lost = "L3: maximum signal 0, requirement 1 (light arrives from only one mounting point";
  expect("@m.csv --survive-failure",
         {"2 cannot be reached even by all candidates together if", lost, "\n  infeasible; ",
          "solver not needed\n"},
         1);
  expect("@m.csv --survive-failure --model non-cooperative",
         {"if any one unit fails: 2 cannot be reached by two units.\n", lost}, 1);
  expect("@m.csv --forbid @pairs.csv",
         {"because some candidates must not be chosen together (proven by",
          "\n  1 pair of candidates is excluded"},
         1);
  expect("@dark.csv", {"L2: maximum signal 0, requirement 1 (no light arrives; "}, 1);
  expect("@day.csv --survive-failure",
         {"3 transceivers reach all 2 labels (cooperative, even if any one unit fails)"});
  expect("@day.csv @night.csv",
         {"2 transceivers reach all 3 labels",
          "day: 2 labels; the label with the minimum margin (day:L1) receives 2 times",
          "night: 1 label; the label with the minimum margin (night:L1) receives 3 times"});
}

TEST_F(Workflow, PlacePrintsJson) {
  const auto answer = [&](const std::string& line) {
    return Json::parse(told("place --threshold 1 --json " + line));
  };
  const Json reach = answer("@m.csv --at-most 1 -o @reach.json");
  EXPECT_EQ(reach["missed"], (Json{"L3", "L6"}));
  EXPECT_EQ(reach["reached_upper_bound"], 4);
  EXPECT_EQ(json("reach.json")["missed"], reach["missed"]);
  const Json whole = answer("@m.csv --curve");
  EXPECT_EQ(whole["curve"].size(), 2U);
  EXPECT_EQ(whole["curve_complete"], true);
  EXPECT_EQ(whole["curve"][0]["at_most"], 4);
  EXPECT_EQ(whole["critical"][0]["count"], 3);
  const Json two = answer("@day.csv --forbid @pairs.csv @night.csv");
  EXPECT_EQ(two["selected"], (Json{"B", "C"}));
  EXPECT_EQ(two["scenarios"][1]["name"], "night");
}

TEST_F(Workflow, PlansPrintCurveAndSensitivity) {
  const std::string plan = "plan @store.json -o @plan --samples 640 --no-certificate --estimator uniform";
  const std::string text = told(plan + " --curve --sensitivity --reflectance-error 0.25");
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
  told("report @plan");
  EXPECT_TRUE(bytes("plan/report.html") == page) << "rebuilt from what lies in the folder";
  told(plan + " --overwrite");
  EXPECT_FALSE(json("plan/placement.json").contains("sensitivity"));
  EXPECT_FALSE(json("plan/placement.json").contains("curve"));
  EXPECT_EQ(bytes("plan/report.html").find("<section id=\"curve\">"), std::string::npos);
}

TEST_F(Workflow, ScenariosAreNamedByTheirFolders) {
  for (const std::string store : {"full", "empty"})
    told("plan @store.json --samples 320 --estimator uniform --no-certificate -o @" + store);
  const auto placed = [&](const std::string& files) { return Json::parse(told("place --json " + files)); };
  Json answer = placed("@full/signal.h5 @empty/signal.h5");
  EXPECT_EQ(answer["scenarios"][0]["name"], "full/signal");
  EXPECT_EQ(answer["scenarios"][1]["name"], "empty/signal");
  EXPECT_TRUE(answer["critical"][0]["labels"][0].get<std::string>().starts_with("full/signal:")) << answer;
  // The shortest unambiguous names, with the extension if nothing else differs.
  for (const char* name : {"night.h5", "night.hdf5"})
    std::filesystem::copy_file(folder / "full/signal.h5", folder / name);
  EXPECT_EQ(placed("@full/signal.h5 @empty/signal.h5 @night.h5")["scenarios"][2]["name"], "night");
  answer = placed("@night.h5 @night.hdf5");
  EXPECT_EQ(answer["scenarios"][0]["name"], "night.h5");
  EXPECT_EQ(answer["scenarios"][1]["name"], "night.hdf5");
  refused("place @night.h5 @full/../night.h5", {"night.h5", "scenario"});
}

TEST_F(Workflow, AFileHoldsOneObjective) {
  folder.write("two.csv", "label,A,B\nL1,1,1\n");
  const std::string links =
      "export @two.csv -o @m.lp --threshold 1 --objective links --model non-cooperative";
  refused(links, {"--objective links", "--weighted"});
  told(links + " --weighted");
  EXPECT_NE(bytes("m.lp").find("2 "), std::string::npos) << "a unit and its link";
}

}  // namespace
}  // namespace shelfbeam
