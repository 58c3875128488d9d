#include "shelfbeam/base/file.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

#include "support/testing.hpp"

namespace shelfbeam::test {
namespace {

const std::filesystem::path instances = SHELFBEAM_SOURCE_DIR "/test/data/instances";

double sum(const SignalTable& table) {
  double total = 0;
  for (const SignalEntry& entry : table.entries) total += entry.signal;
  return total;
}

// Counts and sums were computed with zcat and awk. The sum of k rounded terms is within k * 2^-53 of its
// size.
TEST(ReferenceInstances, Thesis) {
  const auto path = instances / "thesis_s1_e0.txt.gz";
  const SignalTable table = read_signal_table(path);
  EXPECT_EQ(table.rows(), 300u);
  EXPECT_EQ(table.columns(), 150u);
  EXPECT_EQ(table.entries.size(), 45000u);
  EXPECT_EQ(table.labels[299].requirement, 1);
  EXPECT_EQ(table.labels[299].single_requirement, 0.58454941);
  EXPECT_NEAR(sum(table), 32613.1494, 1e-6);
}

TEST(ReferenceInstances, Supermarket) {
  const SignalTable table = read_signal_table(instances / "super_s1_e0_part.txt.gz");
  EXPECT_EQ(table.rows(), 680u);
  EXPECT_EQ(table.columns(), 600u);
  EXPECT_EQ(table.entries.size(), 407994u);
  EXPECT_EQ(table.labels[0].single_requirement, 0.437292221);
  EXPECT_NEAR(sum(table), 25147.8543, 1e-6);
}

TEST(ReferenceInstances, TruncatedGzipIsRefused) {
  const std::string whole = read_file(instances / "thesis_s1_e0.txt.gz");
  for (const std::size_t length :
       {std::size_t{3}, std::size_t{12}, whole.size() / 2, whole.size() - 9, whole.size() - 1})
    expect_file_refused(read_signal_table, whole.substr(0, length));
  std::string damaged = whole;
  damaged[whole.size() / 2] = static_cast<char>(damaged[whole.size() / 2] ^ 0x10);
  expect_file_refused(read_signal_table, damaged);
}

}  // namespace
}  // namespace shelfbeam::test
