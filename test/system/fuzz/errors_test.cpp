// One error of each family in full: test/data/errors.txt. Other tests check places and values.

#include <limits>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "shelfbeam/placement/problem/placement_problem.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

#include "reader.hpp"
#include "scratch_folder.hpp"
#include "small_values.hpp"
#include "support/expect_input_error.hpp"
#include "support/small_store.hpp"
#include "support/snapshot.hpp"

namespace shelfbeam::fuzz {
namespace {

// A seed of the reader in which `to` replaces `from`; a whole file where `from` is empty.
struct Bad {
  std::string_view reader, from, to;
};
constexpr Bad bad_files[] = {
    {"store", R"("reflectance": 0.8)", R"("reflectanse": 0.8)"},
    {"store", R"("k": 8.6, )", ""},
    {"store", R"("k": 8.6)", R"("k": "8.6")"},
    {"store", "[8, 6, 3]", "[8, 6]"},
    {"store", R"("stocking": 0.5)", R"("stocking": 1.5)"},
    {"store", R"("material": "white", )", R"("material": "white", "material": "tile", )"},
    {"store", R"("floor": "tile")", R"("floor": "Tile")"},
    {"store", R"("id": "B")", R"("id": "A")"},
    {"store", "labels.csv", "none.csv"},
    {"store", R"("scale": 0.5)", R"("scale": 1e-5)"},
    {"store", R"([ "till" ])", R"([ "tell" ])"},
    {"store", "[12, 5], [20, 6], [20, 14], [0, 14]]", "[12, 5], [0, 14], [20, 14], [20, 6]]"},
    {"store", R"("outline": [[0, 0], [12, 0])", R"("outline": [[0, 0], [0, 0], [12, 0])"},
    {"store", R"("outline": [[0, 0], [12, 0])", R"("outline": [[0, 0], [0, 1e-9], [12, 0])"},
    {"store", R"("from": [4, 0], "to": [4, 6])", R"("from": [4, 6], "to": [4, 6])"},
    {"store", "[[12, 5], [20, 6], [20, 10], [12, 10]]", "[[5, 3], [20, 6], [20, 10], [5, 10]]"},
    {"store", R"("at": 3, "width": 1)", R"("at": 5.5, "width": 1)"},
    {"store", R"("width": 0.9, "top": 2.1)", R"("width": 0.9, "top": 3.3)"},
    {"store", R"("position": [1, 1, 1])", R"("position": [15, 3, 1])"},
    {"store", R"("base": { "type")", R"("base": { "preset": "run", "type")"},
    {"store", R"("preset": "chest")", R"("preset": "chess")"},
    {"store", R"("step": 1.33, "first": 3, "count2": 2)",
     R"("step": 1.33, "first": 3, "count2": 1000000000)"},
    {"store", R"("area": "room", "spacing": 3)", R"("area": "room", "spacing": 1e-9)"},
    {"store", R"("area": "room", "spacing": 3)", R"("area": "room", "spacing": 0.01)"},
    {"store", R"("spacing": 0.8, "axes")", R"("spacing": 1e-9, "axes")"},
    {"store", R"("wall": 2, "z": 2)", R"("wall": 9, "z": 2)"},
    {"store", "", {"{\n\0}", 4}},
    {"store", "", {"\xFF\xFE{\0", 4}},
    {"planogram", "article,fixture", "artikle,fixture"},
    {"planogram", "A,front,2,2", "A,front,2,1e9"},
    {"planogram", "A,front,2,2", "C,front,2,2"},
    {"planogram", "7,Jam,P,1,1,1", "7,Jam,P,9,1,1"},
    {"planogram", "7,Jam,P,1,1,1", "7,Jam,P,1,3,1"},
    {"catalogue", R"("base": {)", R"("run2": {}, "own": {)"},
    {"device_csv", "id,x,y", "id;x;y"},
    {"device_csv", "P,5,0.01", "P,5,1kg"},
    {"mesh", "f 1/1/1 3//1 2", "f 1 2 9"},
    {"mesh", "vertex 1 0 0", "vertex 1 x 0"},
    {"mesh", R"("count":3,"type":"VEC3","max":[1,1,0])", R"("count":9,"type":"VEC3")"},
    {"ies", "", "hello\n"},
    {"ies", "TILT=INCLUDE", "TILT=lamp.tlt"},
    {"eulumdat", "", "a\nb\n"},
    {"eulumdat", "made by hand\n3\n2\n", "made by hand\n3\n3\n"},
    {"csv_table", "0,1e-3,4", "0,-1e-3,4"},
    {"csv_table", "0,1e-3,4", "0,1e-3"},
    {"csv_table", R"("B, ""2""")", "A"},
    {"csv_table", "", "0,1,2\n0.5,0.25,0\n"},
    {"csv_table", "", "T1,T2\n0.5,0.25\n"},
    {"npy_table", "(2, 3)", "(2, 4)"},
    {"npy_table", "<f4", ">f4"},
    {"or_library", "", "2 4\n1 1 1 1\n2 1 5\n1 1\n"},
    {"or_library", "", "2 3\n5 1 1\n2 1 2\n2 1 2\n"},
    {"sparse_text", "", "2 2 0.5\n2 1 0.1 1 0.2\n0\n"},
    {"sparse_text", "", "1 4000000000 0.5\n0\n"},
    {"matrix", "", "hello world\n"},
    {"selection_csv", "T3,0.5", "T9,0.5"},
    {"selection_csv", "T2,T3", "T2,T2"},
    {"measurements", "signal,error", "signl,error"},
    {"measurements", "L2,T3", "L0,T1"},
    {"placement_file", R"("T1")", R"("T9")"},
    {"checkpoint", "", "hello\n"},
    {"checkpoint", "abc", "abd"},
};

std::string bytes_of(const Bad& bad, const Reader& reader) {
  if (bad.from.empty()) return std::string(bad.to);
  for (std::string& seed : reader.seeds()) {
    const std::size_t at = seed.find(bad.from);
    if (at == std::string::npos) continue;
    seed.replace(at, bad.from.size(), bad.to);
    if (reader.repair != nullptr) reader.repair(seed);
    return seed;
  }
  ADD_FAILURE() << "no seed of " << bad.reader << " has " << bad.from;
  return {};
}

TEST(Errors, EqualTheSnapshot) {
  std::string errors;
  const auto add = [&](const auto& action) {
    std::string message = test::input_error(action);
    const std::string folder = scratch().path().string() + "/";
    for (auto at = message.find(folder); at != std::string::npos; at = message.find(folder))
      message.erase(at, folder.size());
    errors += message + "\n";
  };
  for (const Bad& bad : bad_files) {
    const Reader& reader = *find_reader(bad.reader);
    add([&] { reader.read(bytes_of(bad, reader)); });
  }
  SignalMatrix matrix = small_matrix();
  const auto file = scratch().path() / "signal.h5";
  write_signal_file(matrix, file);
  const std::string whole = read_file(file);
  add([&] { read_signal_table(scratch().write("signal.h5", whole.substr(0, whole.size() - 1))); });
  matrix.mean[5] = std::numeric_limits<float>::quiet_NaN();
  write_signal_file(matrix, file);
  add([&] { read_signal_table(file); });
  SignalTable table = small_table();
  add([&] { check_problem(table, {.share = 0}); });
  table.labels[0].requirement = 0;
  add([&] { check_problem(table, {}); });
  const Scene scene = test::SmallStore{}.scene();
  add([&] { simulate(scene, {.strategy = Strategy::nee}); });
  add([&] { simulate(scene, {.estimator = EstimatorKind::uniform, .strategy = Strategy::walk}); });
  test::expect_snapshot(errors, "errors.txt");
}

}  // namespace
}  // namespace shelfbeam::fuzz
