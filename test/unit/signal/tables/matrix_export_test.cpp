#include "shelfbeam/signal/tables/matrix_export.hpp"

#include <cstring>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

#include "support/testing.hpp"
#include "unit/signal/small_matrix.hpp"

namespace shelfbeam::test {
namespace {

// The table's signals as 32-bit floats, zeros included.
std::vector<float> dense(const SignalTable& table) {
  std::vector<float> values(table.rows() * table.columns(), 0.0f);
  for (std::size_t i = 0; i < table.rows(); ++i)
    for (const SignalEntry& entry : table.row(i))
      values[i * table.columns() + entry.transceiver] = static_cast<float>(entry.signal);
  return values;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

// Ids that are formulas or have separators, plain and safe.
TEST(MatrixExport, CsvRestoresHostileIds) {
  const TempFolder folder;
  SignalMatrix matrix = small_matrix(7, 5);
  const std::vector<std::string> ids{"=1+1", "'=1", "-5", "a;b", "@x, \"y\";"};
  for (std::size_t k = 0; k < ids.size(); ++k) matrix.transceivers[k].id = matrix.labels[k].id = ids[k];
  for (const bool safe : {false, true}) {
    write_matrix_csv(matrix, matrix.mean, folder / "matrix.csv", safe);
    const SignalTable table = read_signal_table(folder / "matrix.csv");
    ASSERT_EQ(table.columns(), ids.size());
    for (std::size_t k = 0; k < ids.size(); ++k) {
      EXPECT_EQ(table.transceivers[k].id, ids[k]);
      EXPECT_EQ(table.labels[k].id, ids[k]);
    }
    EXPECT_TRUE(same_bits(dense(table), matrix.mean));
    EXPECT_EQ(read_file(folder / "matrix.csv").find("\n=1+1,") == std::string::npos, safe);
  }
}

TEST(MatrixExport, SignalFileCsvAndNpyGiveOneTable) {
  const TempFolder folder;
  const SignalMatrix matrix = small_matrix(60, 41);
  write_signal_file(matrix, folder / "signal.h5");
  write_matrix_csv(matrix, matrix.mean, folder / "matrix.csv");
  write_matrix_npy(matrix, matrix.mean, folder / "matrix.npy");
  const SignalTable direct = make_signal_table(matrix), hdf5 = read_signal_table(folder / "signal.h5"),
                    csv = read_signal_table(folder / "matrix.csv"),
                    npy = read_signal_table(folder / "matrix.npy");
  for (const SignalTable* table : {&direct, &hdf5, &csv, &npy}) {
    ASSERT_EQ(table->rows(), matrix.rows());
    ASSERT_EQ(table->columns(), matrix.columns());
    EXPECT_TRUE(same_bits(dense(*table), matrix.mean));
    EXPECT_EQ(table->row_begin, direct.row_begin);
  }
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    EXPECT_EQ(csv.labels[i].id, matrix.labels[i].id);
    EXPECT_EQ(hdf5.labels[i].id, matrix.labels[i].id);
    EXPECT_EQ(hdf5.labels[i].requirement, matrix.labels[i].requirement);
    EXPECT_EQ(hdf5.labels[i].single_requirement, matrix.labels[i].requirement);
    EXPECT_EQ(hdf5.labels[i].link_cost, matrix.labels[i].link_cost);
    EXPECT_EQ(hdf5.labels[i].signal_cost, matrix.labels[i].signal_cost);
  }
  for (std::size_t j = 0; j < matrix.columns(); ++j) {
    EXPECT_EQ(csv.transceivers[j].id, matrix.transceivers[j].id);
    EXPECT_EQ(hdf5.transceivers[j].id, matrix.transceivers[j].id);
    EXPECT_EQ(hdf5.transceivers[j].cost, matrix.transceivers[j].cost);
    EXPECT_EQ(hdf5.transceivers[j].installed, matrix.transceivers[j].installed);
  }
}

TEST(MatrixExport, NineDigitsAreWritten) {
  // Negative control of the round trip: neighbouring floats that are equal in eight significant digits.
  const float a = 1000.00006103515625f, b = 1000.0001220703125f;
  ASSERT_EQ(std::nextafter(a, b), b);
  ASSERT_EQ(fmt::format("{:.8g}", a), fmt::format("{:.8g}", b));
  SignalMatrix matrix = small_matrix(1, 2);
  matrix.mean = {a, b};
  const TempFolder folder;
  write_matrix_csv(matrix, matrix.mean, folder / "m.csv");
  EXPECT_EQ(read_file(folder / "m.csv"), "label,G1-0-0,G1-1-0\nA1-front-0,1000.00006,1000.00012\n");
  EXPECT_TRUE(same_bits(dense(read_signal_table(folder / "m.csv")), matrix.mean));
}

TEST(MatrixExport, NpyHeaderIsAligned) {
  const TempFolder folder;
  for (const std::size_t rows : {1, 10, 100, 1000}) {
    const SignalMatrix matrix = small_matrix(rows, 3);
    write_matrix_npy(matrix, matrix.direct, folder / "m.npy");
    const std::string bytes = read_file(folder / "m.npy");
    const std::size_t header = bytes.size() - 4 * matrix.direct.size();
    EXPECT_EQ(header % 64, 0u);
    EXPECT_EQ(bytes[header - 1], '\n');
    EXPECT_EQ(std::memcmp(bytes.data() + header, matrix.direct.data(), 4 * matrix.direct.size()), 0);
  }
}

TEST(MatrixExport, RefusesValuesOfAnotherSizeAndLeavesNothing) {
  const TempFolder folder;
  const SignalMatrix matrix = small_matrix();
  const auto values = std::span(matrix.mean).first(3);
  EXPECT_THROW(write_matrix_csv(matrix, values, folder / "m.csv"), std::invalid_argument);
  EXPECT_THROW(write_matrix_npy(matrix, values, folder / "m.npy"), std::invalid_argument);
  expect_input_error([&] { write_matrix_csv(matrix, matrix.mean, folder / "none/m.csv"); }, "none/m.csv");
  EXPECT_EQ(folder.count(), 0);
}

}  // namespace
}  // namespace shelfbeam::test
