#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "system/app/program.hpp"

// Every wrong input ends with one clear error that names file and place, and exit code 2. What was in the
// output's place stays to the byte, nothing else appears, and no temporary file is left.

namespace shelfbeam {
namespace {

using test::expect_refused;
using test::Json;
using test::small_store;
using test::TempFolder;

class BadStore : public testing::Test {
 protected:
  BadStore() {
    for (const char* name : {"old.h5", "old.svg", "old/signal.h5", "old/placement.json", "old/store.json",
                             "old/labels.csv", "old/report.html"})
      folder.write(name, std::string("what was here before: ") + name);
  }

  // The file is refused by every verb that reads stores, with an old output in place and without one.
  void expect_refused_by_all(const std::string& file, const std::vector<std::string>& parts) {
    const std::string store = path(file);
    for (const std::string prefix : {"old", "new"}) {
      expect_refused(folder, {"inspect", store, "-o", path(prefix + ".svg")}, parts);
      expect_refused(folder, {"simulate", store, "-o", path(prefix + ".h5"), "--samples", "64"}, parts);
      expect_refused(folder, {"plan", store, "-o", path(prefix), "--samples", "64"}, parts);
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
  std::string path(const std::string& name) const { return (folder / name).string(); }

  TempFolder folder;
};

TEST_F(BadStore, NamesAFileOutsideItsFolder) {
  const auto add_mesh = [](Json& store) {
    store["fixtures"].push_back({{"type", "mesh"},
                                 {"id", "B"},
                                 {"file", "../secret.obj"},
                                 {"at", {1, 1, 0}},
                                 {"materials", {{"*", "m"}}}});
  };
  expect_change_refused(add_mesh, {"fixtures[1].file", "'../secret.obj' lies outside", "(--allow-outside)"});
}

TEST_F(BadStore, MissingFile) {
  expect_refused_by_all("none.json", {path("none.json") + ": cannot be read (No such file or directory)"});
  expect_refused_by_all("none/store.json", {path("none/store.json") + ": cannot be read"});
  expect_refused_by_all("old.h5/store.json", {"cannot be read (Not a directory)"});
  expect_refused_by_all("", {": is a folder, not a file"});
  expect_refused_by_all(std::string(300, 'x'), {"cannot be read (File name too long)"});
}

TEST_F(BadStore, IsToldWhateverTheForm) {
  for (const char* flag : {"--json", "--quiet"})
    expect_refused(folder, {"inspect", path("none.json"), flag}, {"none.json: cannot be read"});
}

TEST_F(BadStore, NotJson) {
  expect_text_refused("", {"is not valid JSON", "line 1"});
  expect_text_refused("name: Kiosk\n", {"is not valid JSON", "line 1"});
  expect_text_refused("{\n  \"name\": \"Kiosk\",\n}", {"is not valid JSON", "line 3"});
  expect_text_refused("{\n  \"wavelength_nm\": NaN }", {"is not valid JSON", "line 2"});
  expect_text_refused("{\n  \"wavelength_nm\": 1e999 }", {"1e999", "line 2"});
  expect_text_refused("[]", {": is an array; an object"});
  expect_text_refused(std::string(100, '['), {"is not valid JSON"});
  expect_text_refused(std::string(100000, '['), {"has more than 100 brackets within each other"});
  expect_text_refused("\x89HDF\r\n\x1a\n", {"is not valid JSON"});
  expect_text_refused("{\"name\": \"a\", \"name\": \"b\"}", {": name: stands twice"});
}

TEST_F(BadStore, UnknownKeyNamesTheNearest) {
  expect_change_refused([](Json& s) { s["fixturs"] = s["fixtures"]; },
                        {": has the unknown key 'fixturs'; did you mean 'fixtures'?"});
  expect_change_refused([](Json& s) { s["fixtures"][0]["labels"]["spaceing"] = 1; },
                        {": fixtures[0].labels: has the unknown key 'spaceing'; did you mean 'spacing'?"});
  expect_change_refused([](Json& s) { s["materials"]["m"]["two\nlines"] = 1; },
                        {"materials.m: has the unknown key 'two\\nlines'"});
}

TEST_F(BadStore, WrongType) {
  expect_change_refused([](Json& s) { s["fixtures"][0]["length"] = "4"; },
                        {": fixtures[0].length: is a text; a number is expected"});
  expect_change_refused([](Json& s) { s["label_types"] = Json::array(); }, {": label_types: is an array"});
  expect_change_refused(
      [](Json& s) {
        s["room"]["size"] = {8, 6};
      },
      {": room.size: has 2 numbers; 3 are expected"});
}

TEST_F(BadStore, NegativeSize) {
  expect_change_refused([](Json& s) { s["room"]["size"][1] = -6; },
                        {": room.size[1]: is -6; it must be greater than 0"});
  expect_change_refused([](Json& s) { s["fixtures"][0]["depth"] = -0.9; }, {": fixtures[0].depth: is -0.9"});
  expect_change_refused([](Json& s) { s["transceivers"]["grids"][0]["spacing"] = 0; },
                        {": transceivers.grids[0].spacing: is 0; it must be greater than 0"});
}

TEST_F(BadStore, ReflectanceAboveOne) {
  expect_change_refused(
      [](Json& s) { s["materials"]["m"]["reflectance"] = 1.01; },
      {": materials.m.reflectance: is 1.01: a surface cannot reflect more than it receives"});
}

TEST_F(BadStore, DuplicateId) {
  expect_change_refused([](Json& s) { s["labels"].push_back(s["labels"][0]); },
                        {": labels[1]: the label id 'door' is used twice, first in", "labels[0]"});
  expect_change_refused([](Json& s) { s["fixtures"].push_back(s["fixtures"][0]); },
                        {": fixtures[1]: the fixture id 'A' is used twice"});
  expect_change_refused(
      [](Json& s) {
        s["transceivers"]["list"] = {{{"id", "G1-1-1"}, {"position", {1, 1, 1}}, {"type", "ceiling"}}};
      },
      {": transceivers.list[0]: the transceiver id 'G1-1-1' is used twice"});
}

TEST_F(BadStore, LabelOutsideTheRoom) {
  expect_change_refused(
      [](Json& s) {
        s["labels"][0]["position"] = {-0.1, 3, 1.5};
      },
      {": labels[0]: label 'door' at (-0.1, 3, 1.5) is outside the room of 8 x 6 x 3 m"});
}

TEST_F(BadStore, NoLabels) {
  expect_change_refused(
      [](Json& s) {
        s["labels"] = Json::array();
        s["fixtures"][0].erase("labels");
      },
      {": has no labels; add 'labels'"});
  folder.write("labels.csv", "id,x,y,z,nx,ny,nz,type\n");
  expect_change_refused(
      [](Json& s) {
        s["labels"] = {{"csv", "labels.csv"}};
        s["fixtures"][0].erase("labels");
      },
      {": has no labels"});
}

TEST_F(BadStore, UnreadableCsv) {
  folder.write("labels.csv",
               "id,x,y,z,nx,ny,nz,type\ndoor,0.1,3,1.5,1,0,0,standard\nsign,1,1,1,x,0,0,standard\n");
  Json store = small_store();
  store["labels"] = {{"csv", "labels.csv"}};
  folder.write("store.json", store.dump());
  expect_refused_by_all("store.json",
                        {"error: " + path("labels.csv") + ": line 3, field 5: is 'x'; a number is expected"});
  store["labels"] = {{"csv", "other.csv"}};
  expect_text_refused(store.dump(), {": labels.csv: the file", "other.csv' does not exist"});
}

TEST_F(BadStore, TransceiverAboveTheCeiling) {
  expect_change_refused([](Json& s) { s["transceivers"]["grids"][0]["z"] = 4.2; },
                        {": transceivers.grids[0]: transceiver 'G1-1-1'", "above the ceiling (4.2 m > 3 m)"});
}

TEST_F(BadStore, UnreadableMesh) {
  const auto with_mesh = [](const char* file) {
    return [file](Json& s) {
      s["fixtures"].push_back(
          {{"type", "mesh"}, {"id", "M"}, {"file", file}, {"at", {1, 1, 0}}, {"materials", {{"*", "m"}}}});
    };
  };
  folder.write("half.glb", read_file(SHELFBEAM_SOURCE_DIR "/examples/grocery/checkout.glb").substr(0, 2000));
  folder.write("noise.obj", "f 1 2 3\nthis is no mesh\n");
  expect_change_refused(with_mesh("none.glb"), {": fixtures[1].file: the mesh", "none.glb' does not exist"});
  expect_change_refused(with_mesh("half.glb"), {": fixtures[1].file: the mesh", "half.glb' cannot be read"});
  expect_change_refused(with_mesh("noise.obj"),
                        {": fixtures[1].file: line 1 of '", "noise.obj': a face names the vertex 1 of 0"});
  expect_change_refused(with_mesh("."), {": fixtures[1].file: '", "is a folder; name a file in it"});
  folder.write("cut.ply",
               "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
               "property float z\nelement face 1\nproperty list uchar int vertex_index\nend_header\n1234");
  expect_change_refused(with_mesh("cut.ply"), {": fixtures[1].file: the mesh", "cut.ply' ends before"});
  folder.write("nan.obj", "v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n");
  expect_change_refused(with_mesh("nan.obj"),
                        {": fixtures[1].file: line 3 of '", "'nan' is no finite number"});
  folder.write("mm.obj", "v 0 0 0\nv 900 0 0\nv 0 400 0\nf 1 2 3\n");
  expect_change_refused(with_mesh("mm.obj"), {": fixtures[1]: mesh 'M' is 900 m across", "\"scale\": 0.001"});
}

TEST_F(BadStore, MoreThanMemoryHolds) {
  // 100,000 labels by 100,000 candidates would be 360 GB.
  Json store = small_store();
  store["room"]["size"] = {1000, 1000, 3};
  store["fixtures"][0]["length"] = 500;
  store["fixtures"][0]["labels"]["spacing"] = 0.02;
  store["transceivers"]["grids"][0].update(Json{{"max", {999, 999}}, {"spacing", 3.2}});
  folder.write("store.json", store.dump());
  for (const char* verb : {"simulate", "plan"})
    expect_refused(folder, {verb, path("store.json"), "-o", path("new")},
                   {"memory: 100001 labels and 97969 candidates need ", " GB, ", "may be used; allow more",
                    "(--memory)"});
}

TEST_F(BadStore, MoreThanTheMemoryAllowed) {
  folder.write("store.json", small_store().dump());
  // 17 x 12 entries with three sums in double and a column index each, and what an item takes.
  expect_refused(
      folder,
      {"simulate", path("store.json"), "-o", path("new.h5"), "--estimator", "uniform", "--memory", "6K"},
      {"memory: 17 labels and 12 candidates need ", "6e-06 GB may be used", "(--memory)"});
  test::expect_silent({"simulate", path("store.json"), "-o", path("new.h5"), "--quiet", "--memory", "12K",
                       "--samples", "64", "--estimator", "uniform"});
}

class BadOutput : public BadStore {
 protected:
  BadOutput() { folder.write("store.json", small_store().dump()); }
};

TEST_F(BadOutput, Unwritable) {
  const std::string store = path("store.json");
  // Below a regular file, and where not even root may: CI runs as root, which permission bits do not stop.
  for (const std::string& place : {path("old.h5") + "/sub", std::string("/proc/shelfbeam"), path("none")}) {
    const std::string quoted = "error: " + place;
    expect_refused(folder, {"inspect", store, "-o", place + "/plan.svg"}, {quoted, "cannot be written"});
    expect_refused(folder, {"simulate", store, "-o", place + "/signal.h5"}, {quoted, "cannot be written"});
  }
  for (const std::string& place : {path("old.h5"), path("old.h5") + "/sub", std::string("/proc/shelfbeam")}) {
    expect_refused(folder, {"plan", store, "-o", place}, {"error: " + place, "cannot be written"});
    expect_refused(folder, {"new", "thesis", place}, {"error: " + place, "cannot be written"});
  }
}

TEST_F(BadOutput, FolderInTheWay) {
  std::filesystem::create_directory(folder / "full");
  std::filesystem::create_directory(folder / "full/report.html");
  expect_refused(folder, {"simulate", path("store.json"), "-o", path("full")},
                 {"cannot be written (it is a folder)"});
  expect_refused(folder, {"plan", path("store.json"), "-o", path("full")},
                 {"full/report.html: cannot be written (it is a folder)"});
}

TEST_F(BadOutput, DeviceStaysADevice) {
  expect_refused(folder, {"simulate", path("store.json"), "-o", "/dev/null", "--samples", "64"},
                 {"/dev/null: cannot be written (it is no regular file)"});
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST_F(BadOutput, WouldOverwriteTheInput) {
  const std::string store = path("store.json");
  const std::string again = path("old/../store.json");
  expect_refused(folder, {"simulate", store, "-o", again}, {again, "is the input"});
  expect_refused(folder, {"inspect", store, "-o", store}, {store, "is the input"});
  expect_refused(folder, {"plan", store, "-o", folder.path().string()}, {"is the folder of the store file"});
  expect_refused(folder, {"new", "thesis", folder.path().string()}, {"store.json: exists already"});
  const std::string matrix = folder.write("matrix.csv", "1,2\n3,4\n").string();
  const std::string costs = folder.write("costs.csv", "id,cost\n1,2\n").string();
  expect_refused(folder, {"place", matrix, "-o", matrix, "--threshold", "1"}, {matrix, "is the input"});
  expect_refused(folder, {"place", matrix, "-o", costs, "--costs", costs}, {costs, "is the input"});
  expect_refused(folder, {"export", matrix, "-o", matrix}, {matrix, "is the input"});
}

class BadMatrix : public testing::Test {
 protected:
  BadMatrix() {
    folder.write("old.json", "old placement");
    folder.write("old.mps", "old model");
  }
  void expect_text_refused(const std::string& text, const std::vector<std::string>& parts) {
    const std::string file = folder.write("matrix", text).string();
    auto all = parts;
    all.push_back("error: " + file);
    for (const std::string prefix : {"old", "new"}) {
      expect_refused(folder, {"place", file, "-o", path(prefix + ".json"), "--threshold", "1"}, all);
      expect_refused(folder, {"export", file, "-o", path(prefix + ".mps"), "--threshold", "1"}, all);
    }
  }
  std::string path(const std::string& name) const { return (folder / name).string(); }
  TempFolder folder;
};

TEST_F(BadMatrix, EntriesThatAreNoSignals) {
  const std::string head = "label,T1,T2\n";
  expect_text_refused(head + "L1,1,2\nL2,3,nan\n", {"line 3, field 3", "NaN"});
  expect_text_refused(head + "L1,1,2\nL2,-3,4\n", {"line 3, field 2", "not negative"});
  expect_text_refused(head + "L1,inf,2\n", {"line 2, field 2"});
  expect_text_refused(head + "L1,1,two\n", {"line 2, field 3"});
  expect_text_refused(head + "L1,1\n", {"line 2"});
  expect_text_refused(head + "L1,1,2\nL1,3,4\n", {"L1"});
  expect_text_refused("label,T1,T1\nL1,1,2\n", {"T1"});
  expect_text_refused(head, {});
  expect_text_refused("", {"is empty"});
  expect_text_refused("{\"name\": 3}", {});
}

TEST_F(BadMatrix, NumpyEntries) {
  const auto npy = [](const std::vector<float>& values) {
    std::string header =
        "{'descr': '<f4', 'fortran_order': False, 'shape': (1, " + std::to_string(values.size()) + "), }";
    header.append(63 - (header.size() + 10) % 64, ' ');
    header += '\n';
    std::string file("\x93NUMPY\x01\x00", 8);
    file += {static_cast<char>(header.size()), '\0'};
    return file + header + std::string(reinterpret_cast<const char*>(values.data()), 4 * values.size());
  };
  expect_text_refused(npy({1, std::nanf("")}), {"NaN"});
  expect_text_refused(npy({-1, 1}), {"negative"});
  const std::string good = npy({1, 2, 3});
  expect_text_refused(good.substr(0, good.size() - 2), {});
  folder.write("matrix", good);
  test::expect_silent({"place", path("matrix"), "-o", path("new.json"), "--threshold", "1"});
}

TEST_F(BadMatrix, DamagedHdf5) {
  const std::string store = folder.write("store.json", small_store().dump()).string();
  test::expect_silent({"simulate", store, "-o", path("signal.h5"), "--samples", "64", "--quiet"});
  const std::string whole = read_file(path("signal.h5"));
  for (const double share : {0.999, 0.5, 0.1, 0.0})
    expect_text_refused(whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size()))),
                        {});
  for (const std::size_t at : {std::size_t{70}, std::size_t{600}, whole.size() / 2}) {
    std::string damaged = whole;
    damaged[at] ^= 1;
    expect_text_refused(damaged, {"its checksum does not fit"});
  }
  folder.write("matrix", whole);
  test::expect_silent({"place", path("matrix"), "-o", path("new.json")});
}

TEST_F(BadMatrix, WithoutRequirement) {
  const std::string matrix = folder.write("matrix.csv", "1,2\n3,4\n").string();
  expect_refused(folder, {"place", matrix, "-o", path("new.json")}, {"--threshold"});
  expect_refused(folder, {"export", matrix, "-o", path("new.mps")}, {"--threshold"});
  expect_refused(folder, {"export", matrix, "-o", path("new.csv")}, {matrix});
}

TEST_F(BadMatrix, TheMostLabels) {
  const std::string matrix = folder.write("matrix.csv", "label,T1,T2\nL1,1,2\n").string();
  const auto refused = [&](std::vector<std::string> arguments, const std::vector<std::string>& parts) {
    arguments.insert(arguments.begin(), {"place", matrix, "--threshold", "1"});
    expect_refused(folder, arguments, parts);
  };
  refused({"--at-most", "0"}, {"--at-most"});
  refused({"--at-most", "-1"}, {"--at-most"});
  refused({"--at-most", "1.5"}, {"--at-most"});
  refused({"--at-most", "1", "--curve"}, {"--at-most", "--curve"});
  refused({"--at-most", "1", "--objective", "links"}, {"--at-most", "--objective"});
  refused({"--at-most", "1", "--weighted"}, {"--at-most", "--weighted"});
}

TEST_F(BadMatrix, PairsApart) {
  const std::string matrix = folder.write("matrix.csv", "label,T1,T2\nL1,1,2\n").string();
  const std::string pairs = folder.write("pairs.csv", "a,b\nT1,T2\nT1,T9\n").string();
  for (const char* output : {"new.json", "old.json"})
    expect_refused(folder, {"place", matrix, "--threshold", "1", "--forbid", pairs, "-o", path(output)},
                   {pairs, "line 3", "'T9'"});
  expect_refused(folder, {"export", matrix, "--threshold", "1", "--forbid", pairs, "-o", path("new.mps")},
                 {pairs, "line 3", "'T9'"});
  expect_refused(folder, {"place", matrix, "--forbid", pairs, "-o", pairs}, {pairs, "is the input"});
  expect_refused(folder, {"place", matrix, "--threshold", "1", "--min-spacing", "2"},
                 {matrix, "no position", "--forbid"});
  expect_refused(folder, {"place", matrix, "--threshold", "1", "--min-spacing", "-2"}, {"--min-spacing"});
  expect_refused(folder, {"export", matrix, "--min-spacing", "2", "-o", path("new.csv")}, {"--min-spacing"});
}

TEST_F(BadMatrix, ScenariosThatDoNotAgree) {
  const std::string open = folder.write("open.csv", "label,T1,T2\nL1,1,2\n").string();
  const std::string shut = folder.write("shut.csv", "label,T2,T3\nL1,1,2\n").string();
  const auto refused = [&](const std::vector<std::string>& files, const std::vector<std::string>& parts) {
    std::vector<std::string> arguments{"place", "--threshold", "1"};
    arguments.insert(arguments.end(), files.begin(), files.end());
    expect_refused(folder, arguments, parts);
  };
  refused({open, shut}, {"error: " + shut, "'T3'", open});
  refused({open, open}, {"error: " + open, "'open'", "once"});
  refused({open, path("none.csv")}, {path("none.csv"), "cannot be read"});
  expect_refused(folder, {"place", open, shut, "-o", shut}, {shut, "is the input"});
}

TEST_F(BadMatrix, Costs) {
  const std::string matrix = folder.write("matrix.csv", "label,T1,T2\nL1,1,2\n").string();
  for (const std::string costs :
       {"id,cost\nT9,2\n", "id,cost\nT1,-2\n", "id,price\nT1,2\n", "", "id,cost\nT1,nan\n"}) {
    const std::string file = folder.write("costs.csv", costs).string();
    expect_refused(folder, {"place", matrix, "--threshold", "1", "--costs", file, "-o", path("new.json")},
                   {file});
  }
}

TEST(BadSensitivity, IsRefused) {
  const TempFolder folder;
  Json store = small_store();
  const std::string file = folder.write("store.json", store.dump()).string();
  const auto refused = [&](std::vector<std::string> arguments, const std::vector<std::string>& parts) {
    arguments.insert(arguments.begin(), {"plan", file, "-o", (folder / "plan").string()});
    expect_refused(folder, arguments, parts);
  };
  refused({"--reflectance-error", "0.1"}, {"--reflectance-error", "--sensitivity"});
  for (const char* wrong : {"-0.1", "1.1", "much"})
    refused({"--sensitivity", "--reflectance-error", wrong}, {"--reflectance-error"});
  store["materials"]["m"]["reflectance_range"] = {0.9, 0.95};
  folder.write("store.json", store.dump());
  refused({"--sensitivity"}, {file + ": materials.m.reflectance_range: is from 0.9 to 0.95",
                              "with the reflectance between them"});
}

TEST(BadPlanFolder, IsRefusedByReport) {
  const TempFolder folder;
  const std::string store = folder.write("store.json", small_store().dump()).string();
  const std::string plan = (folder / "plan").string();
  test::expect_silent({"plan", store, "-o", plan, "--samples", "320", "--quiet"});
  const auto refused_without = [&](const std::string& name, const std::string& content,
                                   const std::vector<std::string>& parts) {
    const std::string whole = read_file(plan + "/" + name);
    if (content.empty())
      std::filesystem::remove(plan + "/" + name);
    else
      folder.write("plan/" + name, content);
    auto all = parts;
    all.push_back("error: " + plan + "/" + name);
    expect_refused(folder, {"report", plan}, all);
    folder.write("plan/" + name, whole);
  };
  refused_without("store.json", "", {"cannot be read"});
  refused_without("signal.h5", "", {});
  refused_without("placement.json", "", {"cannot be read"});
  refused_without("store.json", "{", {"is not valid JSON"});
  refused_without("signal.h5", "old", {});
  refused_without("placement.json", "{}", {"has no 'format'"});
  Json other = Json::parse(read_file(plan + "/store.json"));
  other["materials"]["m"]["reflectance"] = 0.31;
  folder.write("plan/store.json", other.dump());
  expect_refused(folder, {"report", plan}, {"signal.h5: belongs to another store file"});
  expect_refused(folder, {"report", (folder / "none").string()}, {"none/store.json: cannot be read"});
}

}  // namespace
}  // namespace shelfbeam
