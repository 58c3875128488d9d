#include "shelfbeam/signal/constraints/conflicts.hpp"

#include "support/testing.hpp"
#include "unit/signal/small_matrix.hpp"

namespace shelfbeam::test {
namespace {

using Pairs = std::vector<std::pair<ColumnId, ColumnId>>;

TEST(Conflicts, KeepsADistance) {
  // Units in a row, 1 m apart; unit 2 is installed.
  SignalTable table = make_signal_table(small_matrix());
  add_conflicts(table, 1, "matrix");
  EXPECT_EQ(table.conflicts, Pairs{}) << "exactly the distance is enough";
  add_conflicts(table, 1.5, "matrix");
  EXPECT_EQ(table.conflicts, (Pairs{{0, 1}, {1, 2}, {2, 3}, {3, 4}}));
  add_conflicts(table, 2.1, "matrix");
  EXPECT_EQ(table.conflicts, (Pairs{{0, 1}, {0, 2}, {1, 2}, {1, 3}, {2, 3}, {2, 4}, {3, 4}}))
      << "no pair twice";
}

TEST(Conflicts, IgnoresOptionsOfAPointAndInstalledUnits) {
  SignalMatrix matrix = small_matrix();
  matrix.transceivers[1].position = matrix.transceivers[0].position;
  matrix.transceivers[3].installed = true;
  SignalTable table = make_signal_table(matrix);
  add_conflicts(table, 1.1, "matrix");
  EXPECT_EQ(table.conflicts, (Pairs{{3, 4}}));
}

// Compares with an enumeration of all pairs: random positions in a box, all scales of distance.
TEST(Conflicts, FindsEveryPair) {
  std::uint32_t state = 7;
  const auto random = [&] {
    state = state * 1664525U + 1013904223U;
    return static_cast<double>(state) * 0x1p-32;
  };
  int found = 0;
  for (int k = 0; k < 200; ++k) {
    SignalMatrix matrix = small_matrix(1, 12);
    for (TransceiverColumn& unit : matrix.transceivers)
      unit.position = {4 * random(), 4 * random(), random()};
    const double metres = 6 * random();
    SignalTable table = make_signal_table(matrix);
    add_conflicts(table, metres, "matrix");
    Pairs expected;
    for (std::uint32_t a = 0; a < 12; ++a)
      for (std::uint32_t b = a + 1; b < 12; ++b) {
        const Vec3 p = matrix.transceivers[a].position, q = matrix.transceivers[b].position;
        if (std::hypot(p.x - q.x, p.y - q.y, p.z - q.z) < metres - 1e-6) expected.emplace_back(a, b);
      }
    EXPECT_EQ(table.conflicts, expected);
    found += static_cast<int>(expected.size());
  }
  EXPECT_GT(found, 1000);
  EXPECT_LT(found, 12000);
}

TEST(Conflicts, RequiresPositions) {
  SignalTable table = make_signal_table(small_matrix());
  table.transceivers[1].position.reset();
  expect_input_error([&] { add_conflicts(table, 1, "matrix.csv"); }, "matrix.csv", "'G1-1-0'");
}

TEST(Conflicts, ReadsPairs) {
  const TempFolder folder;
  SignalTable table = make_signal_table(small_matrix());
  forbid_pairs(table, folder.write("p.csv", "a,b\nG1-3-0,G1-1-0\nG1-0-0,G1-2-0\nG1-1-0,G1-3-0\n"));
  EXPECT_EQ(table.conflicts, (Pairs{{0, 2}, {1, 3}}));
  forbid_pairs(table, folder.write("p.csv", "a,b\n"));
  EXPECT_EQ(table.conflicts.size(), 2U);
}

TEST(Conflicts, RefusesBrokenFilesWithPosition) {
  SignalMatrix matrix = small_matrix();
  matrix.transceivers[4].installed = true;
  SignalTable table = make_signal_table(matrix);
  const auto refused = [&](std::string_view content, std::string_view place, std::string_view problem) {
    expect_file_refused([&](const auto& path) { forbid_pairs(table, path); }, content, place, problem);
  };
  refused("", "empty", "'a,b'");
  refused("b,a\n", "line 1", "'a,b'");
  refused("a,b\nG1-0-0\n", "line 2", "1 field");
  refused("a,b\nG1-0-0,G1-1-0\nG1-0-0,G1-1-1\n", "line 3", "'G1-1-1'");
  refused("a,b\nG1-0-0,\n", "line 2", "");
  refused("a,b\nG1-2-0,G1-4-0\n", "line 2", "installed");
  expect_input_error([&] { forbid_pairs(table, "none.csv"); }, "none.csv");
}

}  // namespace
}  // namespace shelfbeam::test
