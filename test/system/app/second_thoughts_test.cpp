// Tests plans that reuse the signals of earlier ones through the program.

#include <csignal>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shelfbeam/signal/hdf5/signal_file.hpp"

#include "system/app/program.hpp"

namespace shelfbeam {
namespace {

using testing::HasSubstr;

class SecondThoughts : public test::ProgramTest {
 protected:
  void write(const test::Json& store) const { folder.write("store.json", store.dump()); }
  SignalMatrix signals(const std::string& plan) const {
    return read_signal_file(folder / plan / "signal.h5");
  }
};

constexpr auto plan = "plan @store.json --samples 1000 --no-certificate";
constexpr auto with_signals = "plan @store.json --no-certificate --signal @first";

TEST_F(SecondThoughts, AboutPricesAndRequirementsKeepTheSignals) {
  test::Json store = test::small_store();
  write(store);
  told(fmt::format("{} -o @first", plan));
  store["transceiver_types"]["ceiling"]["cost"] = 7;
  store["label_types"]["standard"]["safety_factor"] = 1.1;
  store["name"] = "another name";
  write(store);
  const std::string second_plan =
      "plan @store.json --no-certificate --survive-failure --signal @first --seed 2 -o @second";
  EXPECT_THAT(told(second_plan), HasSubstr("read from "));
  const SignalMatrix first = signals("first"), second = signals("second");
  EXPECT_EQ(second.mean, first.mean);
  EXPECT_EQ(second.standard_error, first.standard_error);
  EXPECT_EQ(second.transceivers[0].cost, 7);
  EXPECT_NE(second.provenance.store_hash, first.provenance.store_hash);
  EXPECT_EQ(json("second/run.json")["signals"]["reused"], true);

  // The same placement as from a file with these signals.
  told("place @second/signal.h5 --survive-failure -o @placed.json");
  EXPECT_EQ(json("placed.json").at("selected"), json("second/placement.json").at("selected"));
}

TEST_F(SecondThoughts, AboutTheShopAreSimulatedAgain) {
  test::Json store = test::small_store();
  write(store);
  told(fmt::format("{} -o @first", plan));
  const auto expect_again = [&](const std::string& misfit, const std::string& reason) {
    write(store);
    const std::string text = told("plan @store.json --no-certificate --signal @first --overwrite -o @second");
    EXPECT_THAT(text, HasSubstr(reason));
    EXPECT_THAT(text, HasSubstr("simulated again: "));
    EXPECT_EQ(json("second/run.json")["signals"]["misfit"], misfit);
    EXPECT_NE(signals("second").mean, signals("first").mean);
  };
  store["labels"][0].update({{"id", "new"}, {"position", {0.1, 2, 1.5}}});
  expect_again("labels", "lacks the label 'new'");
  store = test::small_store();
  store["materials"]["m"]["reflectance"] = 0.123;
  expect_again("light", "a material or the wavelength has changed");
}

TEST_F(SecondThoughts, AreOfferedTheSignalsOfThePlanInTheFolder) {
  told(fmt::format("{} -o @first", plan));
  const std::string same = fmt::format("{} --seed 2 -o @first", plan);
  refused(same, {"finished plan", "its signals fit this store", "(--overwrite, --signal)"});
  test::Json store = test::small_store();
  store["materials"]["m"]["reflectance"] = 0.25;
  write(store);
  const test::Outcome other = test::shelfbeam(test::words(folder, same));
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, testing::Not(HasSubstr("its signals fit")));
}

TEST_F(SecondThoughts, PinAndExcludeUnits) {
  test::Json store = test::small_store();
  store["currency"] = "EUR";
  store["transceiver_types"]["ceiling"]["cost"] = 100;
  write(store);
  told(fmt::format("{} -o @first", plan));
  const test::Json first = json("first/placement.json");
  const std::string gone = first["selected"][0];
  told(fmt::format("{} --pin G1-1-1 --exclude {} -o @second", with_signals, gone));
  const test::Json second = json("second/placement.json");
  EXPECT_THAT(second["selected"], testing::Contains("G1-1-1"));
  EXPECT_THAT(second["selected"], testing::Not(testing::Contains(gone)));
  EXPECT_EQ(second["price"]["new"], 100 * second["count"].get<int>()) << "a pinned unit is bought";
  EXPECT_THAT(bytes("second/mounting.csv"), testing::ContainsRegex(",G1-1-1,ceiling,0,.*,1,[^,]*,[^,]*,\n"));
  EXPECT_THAT(bytes("second/placement.csv"), testing::ContainsRegex("\nG1-1-1,.*,1,[^,]*,\n"));
  EXPECT_THAT(bytes("second/report.html"), HasSubstr("(1 chosen by you)"));
  EXPECT_THAT(bytes("second/report.html"), HasSubstr("G1-1-1<br><small>(chosen by you)</small>"));
  EXPECT_THAT(bytes("first/report.html"), testing::Not(HasSubstr("chosen by you")));
  EXPECT_EQ(signals("second").columns() + 1, signals("first").columns());

  // The same as keys of the store, as options of `place`, and from the resolved store.
  store["transceivers"]["pinned"] = {"G1-1-1"};
  store["transceivers"]["excluded"] = {gone};
  write(store);
  told(fmt::format("{} -o @third", with_signals));
  EXPECT_EQ(bytes("third/placement.json"), bytes("second/placement.json"));
  told(fmt::format("place @first/signal.h5 --pin G1-1-1 --exclude {} -o @placed.json", gone));
  EXPECT_EQ(json("placed.json").at("selected"), second.at("selected"));
  told(fmt::format("place @second/signal.h5 --exclude {} -o @placed.json", gone));
  EXPECT_EQ(json("placed.json").at("selected"), second.at("selected"));
  EXPECT_EQ(json("placed.json").at("price"), second.at("price"));
  told("plan @second/store.json --samples 1000 --no-certificate -o @fourth");
  EXPECT_EQ(json("fourth/placement.json").at("selected"), second.at("selected"));

  // A price list names all candidates.
  folder.write("costs.csv", fmt::format("id,cost\nG1-1-1,70\n{},5\n", gone));
  told(fmt::format("{} --costs @costs.csv -o @fifth", with_signals));
  EXPECT_EQ(json("fifth/placement.json")["price"]["new"], 100 * second["count"].get<int>() - 30);
}

TEST_F(SecondThoughts, RefuseUnknownUnits) {
  told(fmt::format("{} -o @first", plan));
  for (const char* flag : {"--pin", "--exclude"}) {
    refused(fmt::format("{} {} G1-11 -o @second", plan, flag), {"'G1-11'", "did you mean 'G1-1-1'?"});
    refused(fmt::format("place @first/signal.h5 {} G1-11", flag),
            {"signal.h5: has no transceiver 'G1-11'", "did you mean 'G1-1-1'?", flag});
  }
  refused(fmt::format("{} --pin G1-1-* --exclude G1-*-1 -o @second", plan), {"pinned unit 'G1-1-1'"});
}

TEST_F(SecondThoughts, AskForAPartOfTheLabels) {
  told(fmt::format("{} -o @first", plan));
  const std::size_t units = json("first/placement.json").at("count");
  ASSERT_GT(units, 1U);
  const std::string fewer = fmt::format("plan @store.json --signal @first --at-most {}", units - 1);
  const std::string text = told(fewer + " -o @fewer");
  EXPECT_THAT(text, HasSubstr("with 99 % confidence"));
  const test::Json placed = json("fewer/placement.json");
  EXPECT_EQ(placed["partial"]["goal"], "at_most");
  EXPECT_EQ(placed["partial"]["value"], units - 1);
  told(fmt::format("place @first/signal.h5 --at-most {} -o @placed.json", units - 1));
  const test::Json alone = json("placed.json");
  EXPECT_EQ(placed.at("selected"), alone.at("selected"));
  EXPECT_EQ(placed["partial"]["reached"], alone.at("reached"));
  EXPECT_EQ(placed["partial"]["reached_upper_bound"], alone.at("reached_upper_bound"));
  const test::Json& certificate = placed.at("certificate");
  EXPECT_LT(certificate.at("reached"), 17);
  EXPECT_FALSE(certificate.at("missed").empty());
  EXPECT_THAT(bytes("fewer/report.html"), HasSubstr("asked for"));

  // The report is rebuilt from the files.
  const std::string page = bytes("fewer/report.html");
  told("report @fewer");
  EXPECT_EQ(bytes("fewer/report.html"), page);

  told("plan @store.json --signal @first --reach 50% -o @half");
  const test::Json half = json("half/placement.json");
  EXPECT_LE(half.at("count"), placed.at("count"));
  EXPECT_EQ(half["partial"]["goal"], "share");
  EXPECT_GE(half.at("certificate").at("reached"), 9);

  refused("plan @store.json -o @bad --at-most 2 --objective links", {"--at-most"});
  refused("plan @store.json -o @bad --reach 0.5 --weighted", {"--reach"});
  refused("plan @store.json -o @bad --at-most 2 --curve", {"--curve"});
}

TEST_F(SecondThoughts, ReportOnAnySelection) {
  told(fmt::format("{} -o @first", plan));
  test::Json placement = json("first/placement.json");
  told("verify @store.json @first/placement.json -o @same --signal @first");
  EXPECT_EQ(json("same/placement.json").at("selected"), placement.at("selected"));
  EXPECT_EQ(json("same/placement.json")["partial"]["goal"], "given");
  EXPECT_EQ(signals("same").mean, signals("first").mean);
  EXPECT_THAT(bytes("same/report.html"), HasSubstr("This selection was given"));

  // The verdicts are those of the CSV file.
  placement["selected"].erase(0);
  placement["count"] = placement["selected"].size();
  folder.write("changed.json", placement.dump());
  told("verify @store.json @changed.json -o @changed --signal @first", 1);
  told("verify @store.json @changed.json -o @changed.csv", 1);
  EXPECT_EQ(bytes("changed/verification.csv"), bytes("changed.csv"));
  const std::string page = bytes("changed/report.html");
  told("report @changed");
  EXPECT_EQ(bytes("changed/report.html"), page);

  // Mounted units need not be candidates.
  folder.write(
      "mounted.csv",
      "id,x,y,z,ax,ay,az,roll_deg,type\nold-1,2,2,2.8,0,0,-1,0,ceiling\nold-2,5,4,2.8,0,0,-1,0,ceiling\n");
  const test::Outcome mounted =
      test::shelfbeam(test::words(folder, "verify @store.json @mounted.csv -o @mounted"));
  EXPECT_EQ(mounted.err, "");
  EXPECT_EQ(json("mounted/placement.json").at("selected"), test::Json({"old-1", "old-2"}));
  EXPECT_EQ(signals("mounted").columns(), 2U);
  for (const char* word : {"greedy", "simple method", "--sensitivity"})
    EXPECT_THAT(bytes("mounted/report.html"), testing::Not(HasSubstr(word)));
  folder.write(
      "pair.csv",
      "id,x,y,z,ax,ay,az,roll_deg,type\nold-1,2,2,2.8,0,0,-1,0,ceiling\nold-2,2,2,2.8,1,0,-1,0,ceiling\n");
  const test::Outcome pair = test::shelfbeam(test::words(folder, "verify @store.json @pair.csv -o @pair"));
  EXPECT_EQ(pair.err, "");
  const std::string of_pair = bytes("pair/report.html");
  told("report @pair");
  EXPECT_EQ(bytes("pair/report.html"), of_pair);
  refused("verify @store.json @pair.csv -o @other --availability 0.9", {"--availability"});
  refused("verify @store.json @first/placement.json -o @first", {"finished plan", "--overwrite"});
  refused("verify @store.json @first/placement.json --overwrite", {"--overwrite"});
}

TEST_F(SecondThoughts, OverwriteThePlanWhoseSignalsTheyReuse) {
  told(fmt::format("{} -o @plan", plan));
  const SignalMatrix first = signals("plan");
  test::Json store = test::small_store();
  store["transceiver_types"]["ceiling"]["cost"] = 7;
  write(store);
  refused("plan @store.json -o @plan --signal @plan", {"contains a finished plan"});
  EXPECT_THAT(told("plan @store.json --no-certificate -o @plan --signal @plan --overwrite"),
              HasSubstr("read from "));
  EXPECT_EQ(signals("plan").mean, first.mean);
  EXPECT_EQ(signals("plan").transceivers[0].cost, 7);
}

TEST_F(SecondThoughts, TellHowManySignalsTheyReuse) {
  told(fmt::format("{} -o @first", plan));
  test::Json store = test::small_store();
  store["labels"] = test::Json::array();
  write(store);
  EXPECT_THAT(told("plan @store.json --no-certificate --signal @first -o @second"),
              HasSubstr("16 labels x 12 candidates, read from the 17 x 12 of "));
}

TEST_F(SecondThoughts, AboutOtherPathsAreSimulatedAgain) {
  told("plan @store.json --samples 1000 --no-certificate --max-bounces 2 -o @first");
  const std::string again = "plan @store.json --no-certificate --samples 64 --signal @first ";
  EXPECT_THAT(told(again + "-o @all"), HasSubstr("another number of bounces"));
  EXPECT_EQ(json("all/run.json")["signals"]["misfit"], "paths");
  EXPECT_THAT(told(again + "--max-bounces 2 -o @two"), HasSubstr("read from "));
}

// Both are stopped after some checkpoints.
TEST_F(SecondThoughts, DoNotReuseAnInterruptedSimulation) {
  const std::string line = "--samples 400000000 --threads 1 --checkpoint-interval 0";
  for (const char* verb : {"plan @store.json -o @plan ", "simulate @store.json -o @signal.h5 "}) {
    test::Process process(test::command(test::words(folder, verb + line)));
    process.wait_for_changes(path(verb[0] == 'p' ? "plan/signal.h5.checkpoint" : "signal.h5.checkpoint"), 3);
    process.send(SIGINT);
    ASSERT_EQ(process.wait().exit_code, 3) << verb;
  }
  int number = 0;
  for (const char* signal : {"@plan", "@plan/signal.h5", "@signal.h5"}) {
    const std::string name = fmt::format("again{}", ++number);
    EXPECT_THAT(told(fmt::format("{} --signal {} -o @{}", plan, signal, name)),
                HasSubstr("its simulation was interrupted"));
    EXPECT_EQ(json(name + "/run.json")["signals"]["misfit"], "incomplete");
  }
}

// A certificate on reused signals continues after an interruption.
TEST_F(SecondThoughts, ResumeTheirCertificates) {
  told("simulate @store.json --samples 1000 -o @signal.h5 --quiet");
  const std::string line = "plan @store.json --signal @signal.h5 ";
  told(line + "-o @whole");
  test::Process process(test::command(test::words(folder, line + "--threads 1 -o @plan")));
  process.wait_for_changes(path("plan"), 1);
  process.send(SIGINT);
  const int code = process.wait().exit_code;
  EXPECT_THAT(told(line + "-o @plan --resume" + (code == 0 ? " --overwrite" : "")), HasSubstr("read from "));
  for (const char* name : {"signal.h5", "placement.json", "labels.csv", "verification.csv"})
    EXPECT_TRUE(bytes(fmt::format("plan/{}", name)) == bytes(fmt::format("whole/{}", name))) << name;
}

TEST_F(SecondThoughts, ReadPlansOfEarlierVersions) {
  for (const char* version : {"0.1.0", "0.2.0", "0.3.0"}) {
    const std::filesystem::path old =
        std::filesystem::path(SHELFBEAM_SOURCE_DIR "/test/system/compatibility") / version;
    test::Json store = test::Json::parse(read_file(old / "plan" / "store.json"));
    store["transceiver_types"].begin().value()["cost"] = 3;
    write(store);
    EXPECT_THAT(told(fmt::format("plan @store.json --no-certificate --signal {} -o @{}",
                                 (old / "plan").string(), version)),
                HasSubstr("read from "))
        << version;
    EXPECT_EQ(signals(version).mean, read_signal_file(old / "plan" / "signal.h5").mean);
  }
}

}  // namespace
}  // namespace shelfbeam
