#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "system/app/program.hpp"

namespace shelfbeam {
namespace {

using test::Json;
using testing::HasSubstr;
using testing::Not;

/// Plans for a kiosk, and for the same with a nearer door label, dearer units and one unit installed.
class Diff : public test::ProgramTest {
 protected:
  Diff() {
    Json changed = json("store.json");
    changed["labels"][0]["position"][1] = 2;
    changed["materials"]["m"]["reflectance"] = 0.35;
    changed["currency"] = "EUR";
    changed["transceiver_types"]["ceiling"]["cost"] = 90;
    changed["transceivers"]["installed"] = {"G1-4-3"};
    folder.write("changed.json", changed.dump());
    told("plan @store.json -o @one --samples 2000 --no-certificate --quiet");
    told("plan @changed.json -o @two --samples 2000 --no-certificate --quiet");
  }
};

TEST_F(Diff, TellsWhatChanged) {
  const std::string text = told("diff @one @two");
  EXPECT_THAT(text, HasSubstr("Before"));
  for (const std::string part :
       {"all 17 labels stay reached", "EUR", "Labels reached", "17 of 17", "Units:", "G1-4-3",
        "Weakest labels of both plans", "Shop: currency is now EUR", "m: reflectance 0.35 instead of 0.3",
        "ceiling: cost 90 instead of 1", "Labels: 1 moved, door", "G1-4-3: installed is now true"})
    EXPECT_THAT(text, HasSubstr(part));
  EXPECT_EQ(told("diff @one/placement.json @two/placement.json"), text);
  EXPECT_EQ(told("diff @one @two --quiet"), "");
  EXPECT_EQ(told("diff @one @one"), "The plans do not differ.\n") << "negative control";
}

TEST_F(Diff, WritesJsonAndPage) {
  const Json there = Json::parse(told("diff @one @two --json -o @page.html"));
  EXPECT_EQ(there["report"], path("page.html"));
  const std::string page = bytes("page.html");
  EXPECT_TRUE(page.starts_with("<!DOCTYPE html>"));
  for (const std::string part : {"G1-4-3", "Floor plan", "currency is now EUR"})
    EXPECT_THAT(page, HasSubstr(part));

  const Json back = Json::parse(told("diff @two @one --json"));
  EXPECT_FALSE(back.contains("report"));
  EXPECT_EQ(there["before"], back["after"]);
  EXPECT_EQ(there["after"], back["before"]);
  EXPECT_EQ(there["units"]["added"], back["units"]["removed"]);
  EXPECT_EQ(there["units"]["removed"], back["units"]["added"]);
  EXPECT_EQ(there["labels"]["gained"].size(), back["labels"]["lost"].size());
  EXPECT_EQ(there["after"]["installed"], 1);
  EXPECT_EQ(there["store"].size(), back["store"].size());
  EXPECT_EQ(there["differs"], true);
  EXPECT_EQ(Json::parse(told("diff @one @one --json"))["differs"], false);
}

// The same signals, prices and places, with another question.
TEST_F(Diff, TellsAnotherQuestion) {
  told("plan @store.json -o @three --signal @one --no-certificate --survive-failure --quiet");
  const std::string text = told("diff @one @three");
  EXPECT_THAT(text, HasSubstr("more: "));
  EXPECT_THAT(text, HasSubstr("Survives the failure of any unit"));
  EXPECT_THAT(text, HasSubstr("The shop is the same."));
  const Json json = Json::parse(told("diff @one @three --json"));
  ASSERT_EQ(json["question"].size(), 1U) << json["question"];
  EXPECT_EQ(json["question"][0]["key"], "survives_failure");
}

TEST_F(Diff, RefusesOtherInput) {
  refused("diff @one @none", {"none: does not exist", "'shelfbeam plan'"});
  refused("diff @store.json @one", {"store.json: is not the folder of a plan"});
  folder.write("empty/note.txt", "");
  refused("diff @one @empty", {"empty/placement.json: ", "folder"});
  refused("diff @empty @one", {"empty/placement.json: "});
  test::fs::remove(folder / "two/signal.h5");
  refused("diff @one @two", {"two/signal.h5: cannot be read"});
  refused("diff @one @one -o @one/store.json", {".html"});
  refused("diff @one @one -o @one/report.html", {"report.html: "});
  refused("diff @one @one -o @absent/page.html", {"absent"});
  refused("diff @one", {"PLAN2"});
}

// Both helps tell which verb compares what.
TEST_F(Diff, IsNotCompare) {
  EXPECT_THAT(told("diff --help"), HasSubstr("'shelfbeam compare'"));
  EXPECT_THAT(told("compare --help"), HasSubstr("'shelfbeam diff'"));
  EXPECT_THAT(told("report --help"), Not(HasSubstr("'shelfbeam diff'"))) << "negative control";
}

}  // namespace
}  // namespace shelfbeam
