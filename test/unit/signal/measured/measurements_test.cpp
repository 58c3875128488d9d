#include "shelfbeam/signal/measured/measurements.hpp"

#include "shelfbeam/signal/measured/comparison.hpp"

#include "support/testing.hpp"
#include "unit/signal/small_matrix.hpp"

namespace shelfbeam::test {
namespace {

TEST(Measurements, OfPairs) {
  const TempFolder folder;
  const Measurements read =
      read_measurements(folder.write("m.csv",
                                     "signal,label,error,transceiver\r\n"
                                     "1.5,\"shelf \"\"A\"\", left\",0.5,G1-3-0\r\n\r\n"
                                     "-2e-3, A1-front-2 ,1e-3,G1-0-0\r\n0,A1-front-2,1e-3,G1-1-0"),
                        small_matrix());
  EXPECT_TRUE(read.of_pairs);
  EXPECT_TRUE(read.has_errors);
  ASSERT_EQ(read.values.size(), 3u);
  EXPECT_EQ(read.values[0].label, 1u);
  EXPECT_EQ(read.values[0].transceiver, 3u);
  EXPECT_EQ(read.values[0].signal, 1.5);
  EXPECT_EQ(read.values[0].error, 0.5);
  EXPECT_EQ(read.values[1].signal, -2e-3);
  EXPECT_EQ(read.values[2].signal, 0);
}

TEST(Measurements, FromEuropeanSpreadsheets) {
  const TempFolder folder;
  const Measurements read = read_measurements(
      folder.write("m.csv",
                   "\xEF\xBB\xBFsep=;\r\nlabel;transceiver;signal\r\nA1-front-2;G1-0-0;-0,002\r\n;;\r\n"),
      small_matrix());
  ASSERT_EQ(read.values.size(), 1u);
  EXPECT_EQ(read.values[0].signal, -2e-3);
}

TEST(Measurements, OfSeveralUnits) {
  const TempFolder folder;
  SignalMatrix matrix = small_matrix();
  matrix.labels[2].batches = 0;
  const Measurements read = read_measurements(folder.write("m.csv", "label,signal\nA1-front-2,7\n"), matrix);
  EXPECT_FALSE(read.of_pairs);
  EXPECT_FALSE(read.has_errors);
  const std::vector<ColumnId> units{0, 2, 4};
  const auto pairs = compared_pairs(matrix, read, units);
  double sum = 0, errors = 0;
  for (const std::uint32_t j : units) {
    sum += static_cast<double>(matrix.mean[matrix.at(2, j)]);
    errors += static_cast<double>(matrix.standard_error[matrix.at(2, j)]);
  }
  EXPECT_EQ(pairs[0].simulated, sum);
  EXPECT_EQ(pairs[0].standard_error, errors);
  EXPECT_EQ(pairs[0].measured, 7);
  EXPECT_FALSE(pairs[0].transceiver.has_value());
  matrix.labels[2].batches = 5;
  EXPECT_NEAR(compared_pairs(matrix, read, units)[0].standard_error, errors * std::sqrt(2.0), 1e-12 * errors)
      << "the variance of Student's t with 4 degrees of freedom is 2";
}

TEST(Measurements, BrokenFilesAreRefusedWithPosition) {
  const auto read = [](const auto& path) { read_measurements(path, small_matrix()); };
  const auto refused = [&](std::string_view content, std::string_view place, std::string_view problem) {
    expect_file_refused(read, content, place, problem);
  };
  refused("", "", "empty");
  refused("label,signal\n", "", "header");
  refused("label,transceiver\n", "line 1", "'signal'");
  refused("label,signal,label\n", "line 1, field 3", "'label'");
  refused("A1-front-0,1\n", "line 1, field 1", "'A1-front-0'");
  refused("label,signal\nA1-frnt-0,1\n", "line 2, field 1", "'A1-front-0'");
  refused("label,transceiver,signal\nA1-front-0,G1-9-0,1\n", "line 2, field 2", "'G1-9-0'");
  refused("label,signal\nA1-front-0,1\nA1-front-2,1\nA1-front-0,2\n", "line 4", "'A1-front-0'");
  refused("label,signal\nA1-front-0,inf\n", "line 2, field 2", "infinite");
  refused("label,signal\nA1-front-0,1 dB\n", "line 2, field 2", "'1 dB'");
  refused("label,signal,error\nA1-front-0,1,0\n", "line 2, field 3", "0");
  refused("label,signal,error\nA1-front-0,1\n", "line 2", "2 fields");
}

}  // namespace
}  // namespace shelfbeam::test
