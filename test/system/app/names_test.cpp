// Names and CSV files of a store, through the program.

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "system/app/program.hpp"

namespace shelfbeam {
namespace {

using test::Json;
using testing::HasSubstr;
using testing::Not;

using Names = test::ProgramTest;

// The program's error for a store, which must be one short line of printable text.
std::string error_of(const test::TempFolder& folder, const Json& store) {
  const test::Outcome outcome =
      test::shelfbeam({"inspect", folder.write("store.json", store.dump()).string()});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_LT(outcome.err.size(), 1100u);
  EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1);
  EXPECT_EQ(outcome.err.find("\xE2\x80\xAE"), std::string::npos);
  EXPECT_EQ(outcome.err.find('\x1B'), std::string::npos);
  return outcome.err;
}

TEST_F(Names, OfOtherCharactersAreRefusedAndEscaped) {
  const std::string turned =
                        "a\xE2\x80\xAE"
                        "b",
                    coloured = "a\x1B[31m";
  for (const std::string& name : {turned, coloured}) {
    const std::string escape = name == turned ? "\\u202e" : "\\x1b";
    Json store = test::small_store();
    store["name"] = name;
    EXPECT_THAT(error_of(folder, store),
                HasSubstr("store.json: name: has the unprintable character '" + escape + "'"));
    store = test::small_store();
    store["fixtures"][0]["id"] = name;
    EXPECT_THAT(error_of(folder, store),
                HasSubstr("fixtures[0].id: has the unprintable character '" + escape));
    store = test::small_store();
    store["materials"][name] = store["materials"]["m"];
    EXPECT_THAT(error_of(folder, store), HasSubstr("materials.a" + escape));
    store = test::small_store();
    store["room"]["floor"] = name;
    EXPECT_THAT(error_of(folder, store), HasSubstr("unknown material 'a" + escape));
  }
}

TEST_F(Names, OfAMegabyteGiveShortErrors) {
  const std::string huge(1'000'000, 'x');
  const auto refused = [&](const auto& change, const std::string& part) {
    Json store = test::small_store();
    change(store);
    const std::string error = error_of(folder, store);
    EXPECT_LT(error.size(), 500u) << error;
    EXPECT_THAT(error, HasSubstr(part));
  };
  refused([&](Json& store) { store["room"]["floor"] = huge; }, "names the unknown material 'xxxx");
  refused([&](Json& store) { store[huge] = 1; }, "has the unknown key 'xxxx");
  refused([&](Json& store) { store["fixtures"][0]["type"] = huge; }, "has the unknown value 'xxxx");
  refused([&](Json& store) { store["materials"][huge] = {{"type", "lambertian"}}; }, ": is missing the key");
  refused([&](Json& store) { store["labels"] = {{"csv", huge}}; }, "is outside the folder");
  refused(
      [&](Json& store) {
        store["labels"].push_back(store["labels"][0]),
            store["labels"][0]["id"] = store["labels"][1]["id"] = huge;
      },
      "has the duplicate label id 'xxxx");
  refused(
      [&](Json& store) {
        store["materials"][huge] = store["materials"]["m"];
        store["room"]["floor"] = "other";
      },
      "known: m, xxxx");
  refused([&](Json& store) { store["materials"]["m"]["reflectance"] = huge; }, "unknown reflectance 'xxxx");
  // A text without its end, and a number of a million digits.
  for (const std::string& text :
       {"{\"name\": \"" + huge, "{\"name\": 1" + std::string(1'000'000, '0') + "}"}) {
    const test::Outcome outcome = test::shelfbeam({"inspect", folder.write("store.json", text).string()});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_LT(outcome.err.size(), 500u);
  }
  // A long name is valid, and its warning is short.
  Json store = test::small_store();
  store["labels"][0]["id"] = huge;
  store["labels"][0]["normal"] = {-1, 0, 0};
  store["labels"][0]["position"] = {0.01, 3, 1.5};
  folder.write("store.json", store.dump());
  EXPECT_LT(told("inspect @store.json").size(), 3000u);
}

TEST_F(Names, ThatAreFormulasAreMadeSafe) {
  Json store = test::small_store();
  store["labels"][0]["id"] = "=1+1";
  store["transceivers"]["list"] = {{{"id", "@T"}, {"position", {4, 1, 2.9}}, {"type", "ceiling"}}};
  store["transceivers"]["installed"] = {"@T"};
  folder.write("store.json", store.dump());
  const std::string plan = "plan @store.json -o @plan --no-certificate --samples 256 --quiet";
  told(plan + " --safe-csv");
  EXPECT_THAT(bytes("plan/labels.csv"), HasSubstr("\n'=1+1,"));
  EXPECT_THAT(bytes("plan/placement.csv"), HasSubstr("\n'@T,"));
  told("report @plan --quiet");
  EXPECT_THAT(bytes("plan/labels.csv"), HasSubstr("\n=1+1,"));
  told("report @plan --quiet --safe-csv");
  EXPECT_THAT(bytes("plan/labels.csv"), HasSubstr("\n'=1+1,"));
  told("export @plan/signal.h5 -o @matrix.csv --safe-csv --quiet");
  EXPECT_THAT(bytes("matrix.csv"), HasSubstr(",'@T\n"));
  EXPECT_THAT(bytes("matrix.csv"), HasSubstr("\n'=1+1,"));
  refused("export @plan/signal.h5 -o @matrix.npy --safe-csv", {"--safe-csv: applies to CSV files only"});
  refused("verify @store.json @plan/placement.json --safe-csv", {"--safe-csv requires --output"});
  folder.write("measured.csv",
               "label;transceiver;signal\r\n'=1+1;'@T;0,5\r\nA-front-1-1;@T;0,25\r\nA-front-1-2;@T;0,5\r\n");
  told("compare @plan/signal.h5 @measured.csv -o @comparison.csv --safe-csv --quiet");
  EXPECT_THAT(bytes("comparison.csv"), HasSubstr("\n'=1+1,'@T,0.5,"));
  told("verify @store.json @plan/placement.csv -o @verification.csv --safe-csv --quiet");
  EXPECT_THAT(bytes("verification.csv"), HasSubstr("\n'=1+1,"));
}

// The CSV files of a plan are in metres, also beside a store in millimetres.
TEST_F(Names, UnitsOfTheStoreDoNotApplyToFilesOfAPlan) {
  Json store = test::small_store();
  told("plan @store.json -o @plan --no-certificate --samples 256 --quiet");
  store["units"] = "mm";
  store["room"]["size"] = {8000, 6000, 3000};
  Json& fixture = store["fixtures"][0];
  fixture["at"] = {2000, 2500};
  fixture["length"] = 4000, fixture["depth"] = 900, fixture["height"] = 1800,
  fixture["shelves"] = {500, 1200};
  fixture["labels"]["spacing"] = 1000;
  store["labels"][0]["position"] = {100, 3000, 1500};
  Json& grid = store["transceivers"]["grids"][0];
  grid["min"] = {1000, 1000}, grid["max"] = {7000, 5000}, grid["spacing"] = 2000, grid["z"] = 2900;
  folder.write("mm.json", store.dump());
  const auto hash = [&](const std::string& file) {
    return Json::parse(told("inspect @" + file + " --json"))["store_hash"];
  };
  EXPECT_EQ(hash("mm.json"), hash("store.json"));
  for (const std::string file : {"mm", "store"})
    told("verify @" + file + ".json @plan/placement.csv --quiet -o @" + file + ".csv");
  EXPECT_EQ(bytes("mm.csv"), bytes("store.csv"));
  // Negative control: without the columns of a plan, the numbers are millimetres, outside the shop.
  folder.write("units.csv", "id,x,y,z,ax,ay,az,roll_deg,type\nT,9000,1000,2900,0,0,-1,0,ceiling\n");
  refused("verify @mm.json @units.csv", {"units.csv: line 2", "'T' at (9, 1, 2.9) is outside the room"});
}

}  // namespace
}  // namespace shelfbeam
