#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "system/app/program.hpp"

// Every wrong input causes one clear error that names file and position, and exit code 2. An existing output
// stays unchanged to the byte; no other file appears, and no temporary file remains.

namespace shelfbeam {
namespace {

using test::Json;
using test::small_store;

class BadStore : public test::ProgramTest {
 protected:
  BadStore() {
    for (const char* name : {"old.h5", "old.svg", "old/signal.h5", "old/placement.json", "old/store.json",
                             "old/labels.csv", "old/report.html"})
      folder.write(name, std::string("what was here before: ") + name);
  }

  // Every verb that reads stores refuses the file, with and without an existing output.
  void expect_refused_by_all(const std::string& file, const std::vector<std::string>& parts) {
    for (const std::string prefix : {"old", "new"})
      for (const std::string& command :
           {"inspect -o @" + prefix + ".svg", "simulate --samples 64 -o @" + prefix + ".h5",
            "plan --samples 64 -o @" + prefix}) {
        std::vector<std::string> arguments = test::words(folder, command);
        arguments.insert(arguments.begin() + 1, path(file));
        test::expect_refused(folder, arguments, parts);
      }
  }
  void expect_text_refused(const std::string& text, const std::vector<std::string>& parts) {
    const std::string file = folder.write("store.json", text).string();
    auto all = parts;
    all.push_back("error: " + file);
    expect_refused_by_all("store.json", all);
  }
  void expect_change_refused(const std::function<void(Json&)>& change,
                             const std::vector<std::string>& parts) {
    Json store = small_store();
    change(store);
    expect_text_refused(store.dump(1), parts);
  }
};

TEST_F(BadStore, NamesAFileOutsideItsFolder) {
  const auto add_mesh = [](Json& store) {
    store["fixtures"].push_back({{"type", "mesh"},
                                 {"id", "B"},
                                 {"file", "../secret.obj"},
                                 {"at", {1, 1, 0}},
                                 {"materials", {{"*", "m"}}}});
  };
  expect_change_refused(add_mesh, {"fixtures[1].file", "'../secret.obj'", "(--allow-outside)"});
}

TEST_F(BadStore, MissingFile) {
  expect_refused_by_all("none.json", {path("none.json") + ": ", "No such file or directory"});
  expect_refused_by_all("old.h5/store.json", {"Not a directory"});
  expect_refused_by_all("", {"folder"});
  expect_refused_by_all(std::string(300, 'x'), {"File name too long"});
  for (const std::string form : {"--json", "--quiet"}) refused("inspect @none.json " + form, {"none.json: "});
}

TEST_F(BadStore, NotJson) {
  expect_text_refused("", {"line 1"});
  expect_text_refused("{\n  \"wavelength_nm\": 1e999 }", {"1e999", "line 2"});
  expect_text_refused("\x89HDF\r\n\x1a\n", {"JSON"});
}

// One wrong value of each kind; the tests of the readers have more.
TEST_F(BadStore, OneWrongValue) {
  struct Case {
    std::string place, value, message;
  };
  for (const Case& wrong : std::vector<Case>{
           {"/fixtures/0/labels/spaceing", "1", "'spacing'"},
           {"/materials/m/two\nlines", "1", "'two\\nlines'"},
           {"/transceivers/list", R"([{"id": "G1-1-1", "position": [1, 1, 1], "type": "ceiling"}])",
            ": transceivers.list[0]: "},
           {"/labels/0/position", "[-0.1, 3, 1.5]", ": labels[0]: label 'door' at (-0.1, 3, 1.5)"}})
    expect_change_refused([&](Json& s) { s[Json::json_pointer(wrong.place)] = Json::parse(wrong.value); },
                          {wrong.message});
}

TEST_F(BadStore, UnreadableCsv) {
  folder.write("labels.csv",
               "id,x,y,z,nx,ny,nz,type\ndoor,0.1,3,1.5,1,0,0,standard\nsign,1,1,1,x,0,0,standard\n");
  Json store = small_store();
  store["labels"] = {{"csv", "labels.csv"}};
  folder.write("store.json", store.dump());
  expect_refused_by_all("store.json", {"error: " + path("labels.csv") + ": line 3, field 5: ", "'x'"});
}

TEST_F(BadStore, ExceedsMemory) {
  // 100,000 labels by 100,000 candidates would be 360 GB.
  Json store = small_store();
  store["room"]["size"] = {1000, 1000, 3};
  store["fixtures"][0]["length"] = 500;
  store["fixtures"][0]["labels"]["spacing"] = 0.02;
  store["transceivers"]["grids"][0].update(Json{{"max", {999, 999}}, {"spacing", 3.2}});
  folder.write("store.json", store.dump());
  expect_refused(folder, {"plan", path("store.json"), "-o", path("new")},
                 {"memory: 100001 labels and 97969 candidates ", " GB", "(--memory)"}, 5);
}

TEST_F(BadStore, ExceedsTheMemoryLimit) {
  folder.write("store.json", small_store().dump());
  // 17 x 12 entries with three sums in double and a column index each, plus the memory of an item.
  refused("simulate @store.json -o @new.h5 --estimator uniform --memory 6K",
          {"memory: 17 labels and 12 candidates ", "6e-06 GB", "(--memory)"}, 5);
  told("simulate @store.json -o @new.h5 --quiet --memory 12K --samples 64 --estimator uniform");
}

using BadOutput = BadStore;

TEST_F(BadOutput, Unwritable) {
  // Below a regular file, and where even root cannot write: CI runs as root, who ignores permission bits.
  for (const std::string place : {"@old.h5/sub", "/proc/shelfbeam", "@none"}) {
    const std::string quoted = "error: " + test::words(folder, place).front();
    refused("inspect @store.json -o " + place + "/plan.svg", {quoted});
    refused("simulate @store.json -o " + place + "/signal.h5", {quoted});
  }
  for (const std::string place : {"@old.h5", "@old.h5/sub", "/proc/shelfbeam"}) {
    const std::string quoted = "error: " + test::words(folder, place).front();
    refused("plan @store.json -o " + place, {quoted});
    refused("new thesis " + place, {quoted});
  }
}

TEST_F(BadOutput, PathIsAFolder) {
  std::filesystem::create_directories(folder / "full/report.html");
  refused("simulate @store.json -o @full", {"full: "});
  refused("plan @store.json -o @full", {"full/report.html: "});
}

TEST_F(BadOutput, DeviceStaysADevice) {
  refused("simulate @store.json -o /dev/null --samples 64", {"/dev/null: "});
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST_F(BadOutput, WouldOverwriteTheInput) {
  folder.write("matrix.csv", "1,2\n3,4\n");
  folder.write("costs.csv", "id,cost\n1,2\n");
  refused("simulate @store.json -o @old/../store.json", {"error: " + path("old/../store.json") + ": "});
  refused("inspect @store.json -o @store.json", {"error: " + path("store.json") + ": "});
  refused("plan @store.json -o " + folder.path().string(), {folder.path().string() + ": "});
  refused("new thesis " + folder.path().string(), {"store.json: "});
  refused("place @matrix.csv -o @matrix.csv --threshold 1", {"error: " + path("matrix.csv") + ": "});
  refused("place @matrix.csv -o @costs.csv --costs @costs.csv", {"error: " + path("costs.csv") + ": "});
  refused("export @matrix.csv -o @matrix.csv", {"error: " + path("matrix.csv") + ": "});
}

class BadMatrix : public test::ProgramTest {
 protected:
  BadMatrix() {
    folder.write("old.json", "old placement");
    folder.write("old.mps", "old model");
  }
  void expect_text_refused(const std::string& text, std::vector<std::string> parts) {
    parts.push_back("error: " + folder.write("matrix", text).string());
    for (const std::string prefix : {"old", "new"}) {
      refused("place @matrix --threshold 1 -o @" + prefix + ".json", parts);
      refused("export @matrix --threshold 1 -o @" + prefix + ".mps", parts);
    }
  }
};

TEST_F(BadMatrix, InvalidEntries) {
  const std::string head = "label,T1,T2\n";
  expect_text_refused(head + "L1,1,2\nL2,3,nan\n", {"line 3, field 3", "NaN"});
  expect_text_refused(head + "L1,1,2\nL1,3,4\n", {"L1"});
  expect_text_refused(head, {});
  expect_text_refused("", {});
  expect_text_refused("{\"name\": 3}", {});
}

TEST_F(BadMatrix, DamagedHdf5) {
  told("simulate @store.json -o @signal.h5 --samples 64 --quiet");
  const std::string whole = bytes("signal.h5");
  expect_text_refused(whole.substr(0, whole.size() / 2), {});
  std::string damaged = whole;
  damaged[600] ^= 1;
  expect_text_refused(damaged, {"checksum"});
  folder.write("matrix", whole);
  told("place @matrix -o @new.json");
}

// Flags, lists and further matrices that do not fit the matrix.
TEST_F(BadMatrix, OptionsThatDoNotFitTheMatrix) {
  folder.write("m.csv", "label,T1,T2\nL1,1,2\n");
  folder.write("plain.csv", "1,2\n3,4\n");
  folder.write("shut.csv", "label,T2,T3\nL1,1,2\n");
  folder.write("pairs.csv", "a,b\nT1,T2\nT1,T9\n");
  folder.write("one.json", R"({"format": 2, "selected": ["T1"]})");
  folder.write("two.json", R"({"format": 2, "selected": ["T1", "T2"]})");
  folder.write("other.json", R"({"format": 2, "selected": ["T9"]})");
  folder.write("weights.csv", "id,weight\nL9,1\n");
  for (const auto& [line, parts] : std::vector<std::pair<std::string, std::vector<std::string>>>{
           {"place @plain.csv -o @new.json", {"--threshold"}},
           {"export @plain.csv -o @new.mps", {"--threshold"}},
           {"export @plain.csv -o @new.csv", {path("plain.csv")}},
           {"place @m.csv --threshold 1 --at-most 0", {"--at-most"}},
           {"place @m.csv --threshold 1 --at-most -1", {"--at-most"}},
           {"place @m.csv --threshold 1 --at-most 1.5", {"--at-most"}},
           {"place @m.csv --threshold 1 --at-most 1 --curve", {"--at-most", "--curve"}},
           {"place @m.csv --threshold 1 --at-most 1 --objective links", {"--at-most", "objective"}},
           {"place @m.csv --threshold 1 --at-most 1 --weighted", {"--at-most", "sum of costs"}},
           {"place @m.csv --threshold 1 --reach 0", {"--reach"}},
           {"place @m.csv --threshold 1 --reach 101%", {"--reach"}},
           {"place @m.csv --threshold 1 --reach 1.5", {"--reach"}},
           {"place @m.csv --threshold 1 --reach 0.5 --at-most 1", {"--reach", "--at-most"}},
           {"place @m.csv --threshold 1 --reach 0.5 --curve", {"--reach", "--curve"}},
           {"place @m.csv --threshold 1 --reach 0.5 --objective links", {"--reach", "objective"}},
           {"place @m.csv --threshold 1 --reach 0.5 --weighted", {"--reach", "sum of costs"}},
           {"place @m.csv --threshold 1 --weights @weights.csv",
            {"--weights", "--at-most, --reach or --curve"}},
           {"place @m.csv --threshold 1 --at-most 1 --weights @weights.csv -o @new.json",
            {path("weights.csv"), "line 2", "'L9'"}},
           {"place @m.csv --threshold 1 --at-most 1 --weights @none.csv", {path("none.csv")}},
           {"place @m.csv --threshold 1 --reach 0.5 --weights @weights.csv -o @weights.csv",
            {"error: " + path("weights.csv") + ": "}},
           {"place @m.csv --threshold 2 --start @one.json",
            {path("one.json"), "does not reach 1 of 1 labels"}},
           {"place @m.csv --threshold 2 --at-most 1 --start @two.json",
            {path("two.json"), "selects 2 units"}},
           {"place @m.csv --threshold 2 --start @other.json", {path("other.json"), "'T9'"}},
           {"place @m.csv --threshold 2 --start @one.json -o @one.json", {path("one.json")}},
           {"place @m.csv --threshold 1 --forbid @pairs.csv -o @new.json",
            {path("pairs.csv"), "line 3", "'T9'"}},
           {"place @m.csv --threshold 1 --forbid @pairs.csv -o @old.json",
            {path("pairs.csv"), "line 3", "'T9'"}},
           {"export @m.csv --threshold 1 --forbid @pairs.csv -o @new.mps",
            {path("pairs.csv"), "line 3", "'T9'"}},
           {"place @m.csv --forbid @pairs.csv -o @pairs.csv", {"error: " + path("pairs.csv") + ": "}},
           {"place @m.csv --threshold 1 --min-spacing 2", {path("m.csv"), "position", "--forbid"}},
           {"place @m.csv --threshold 1 --min-spacing -2", {"--min-spacing"}},
           {"export @m.csv --min-spacing 2 -o @new.csv", {"--min-spacing"}},
           {"place @m.csv @shut.csv --threshold 1", {"error: " + path("shut.csv"), "'T3'", path("m.csv")}},
           {"place @m.csv @m.csv --threshold 1", {"error: " + path("m.csv"), "'m'"}},
           {"place @m.csv @none.csv --threshold 1", {"error: " + path("none.csv") + ": "}},
           {"place @m.csv @shut.csv -o @shut.csv", {"error: " + path("shut.csv") + ": "}}})
    refused(line, parts);
  for (const char* costs : {"id,cost\nT9,2\n", "id,price\nT1,2\n"}) {
    folder.write("costs.csv", costs);
    refused("place @m.csv --threshold 1 --costs @costs.csv -o @new.json",
            {"error: " + path("costs.csv") + ": "});
  }
}

TEST_F(BadStore, RangesOfReflectances) {
  const std::string plan = "plan @store.json -o @plan ";
  refused(plan + "--reflectance-error 0.1", {"--reflectance-error", "--sensitivity"});
  for (const std::string wrong : {"-0.1", "1.1", "much"})
    refused(fmt::format("{}--sensitivity --reflectance-error {}", plan, wrong), {"--reflectance-error"});
  Json store = small_store();
  store["materials"]["m"]["reflectance_range"] = {0.9, 0.95};
  folder.write("store.json", store.dump());
  refused(plan + "--sensitivity", {"store.json: materials.m.reflectance_range: ", "0.9", "0.95", "0.3"});
}

using BadPlanFolder = test::ProgramTest;

TEST_F(BadPlanFolder, IsRefusedByReport) {
  told("plan @store.json -o @plan --samples 320 --quiet");
  struct Case {
    std::string name, content;  // without content the file does not exist
    std::vector<std::string> parts;
  };
  for (auto [name, content, parts] : std::vector<Case>{{"store.json", "", {}},
                                                       {"signal.h5", "", {}},
                                                       {"placement.json", "", {}},
                                                       {"store.json", "{", {"JSON"}},
                                                       {"signal.h5", "old", {}},
                                                       {"placement.json", "{}", {"'format'"}}}) {
    const std::string file = "plan/" + name, whole = bytes(file);
    if (content.empty())
      std::filesystem::remove(folder / file);
    else
      folder.write(file, content);
    parts.push_back("error: " + path(file));
    refused("report @plan", parts);
    folder.write(file, whole);
  }
  Json other = json("plan/store.json");
  other["materials"]["m"]["reflectance"] = 0.31;
  folder.write("plan/store.json", other.dump());
  refused("report @plan", {"signal.h5: "});
  refused("report @none", {"none/store.json: "});
}

}  // namespace
}  // namespace shelfbeam
