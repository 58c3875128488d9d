#include "shelfbeam/signal/tables/signal_table.hpp"

#include <gtest/gtest.h>

#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/signal/tables/matrix_export.hpp"

#include "support/expect_input_error.hpp"
#include "support/temp_folder.hpp"
#include "unit/signal/small_matrix.hpp"

namespace shelfbeam {
namespace {

using test::expect_input_error;
using test::small_matrix;
using Mounts = std::vector<std::vector<std::uint32_t>>;

// Columns 0, 3 and 4 at one point up to rounding.
SignalMatrix with_options() {
  SignalMatrix matrix = small_matrix();
  matrix.transceivers[3].position = matrix.transceivers[0].position;
  matrix.transceivers[4].position = matrix.transceivers[0].position;
  matrix.transceivers[4].position.z += 5e-7;
  return matrix;
}

TEST(SignalTable, CandidatesAtOnePositionAreOptions) {
  EXPECT_EQ(make_signal_table(small_matrix()).mounts, Mounts{});
  EXPECT_EQ(make_signal_table(small_matrix()).mounting_points(), 5U);
  SignalMatrix matrix = with_options();
  EXPECT_EQ(make_signal_table(matrix).mounts, (Mounts{{0, 3, 4}}));
  EXPECT_EQ(make_signal_table(matrix).mounting_points(), 3U);
  matrix.transceivers[4].position.z += 0.01;
  EXPECT_EQ(make_signal_table(matrix).mounts, (Mounts{{0, 3}}));

  const test::TempFolder folder;
  write_signal_file(with_options(), folder / "signal.h5");
  EXPECT_EQ(read_signal_table(folder / "signal.h5").mounts, (Mounts{{0, 3, 4}}));
  // A matrix without positions knows no points.
  write_matrix_csv(with_options(), with_options().mean, folder / "signal.csv");
  EXPECT_EQ(read_signal_table(folder / "signal.csv").mounts, Mounts{});
}

TEST(SignalTable, RefusesTwoInstalledUnitsAtOnePoint) {
  SignalMatrix matrix = with_options();
  matrix.transceivers[3].installed = true;
  EXPECT_NO_THROW(make_signal_table(matrix));
  matrix.transceivers[4].installed = true;
  expect_input_error([&] { make_signal_table(matrix); }, "/transceivers/installed", "'G1-3-0' and 'G1-4-0'",
                     "same mounting point");
  const test::TempFolder folder;
  write_signal_file(matrix, folder / "signal.h5");
  expect_input_error([&] { read_signal_table(folder / "signal.h5"); }, "signal.h5: /transceivers/installed",
                     "'G1-3-0' and 'G1-4-0'");
}

}  // namespace
}  // namespace shelfbeam
