#include "support/documentation.hpp"

#include "shelfbeam/signal/constraints/conflicts.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

#include "support/testing.hpp"

namespace shelfbeam::test {
namespace {

TEST(Documentation, ExamplesOfTheMatrixFormatsAreRead) {
  const auto csv = fenced_blocks("matrices.md", "csv");
  const auto text = fenced_blocks("matrices.md", "text");
  ASSERT_EQ(csv.size(), 6u);
  ASSERT_EQ(text.size(), 3u);
  const TempFolder folder;
  const auto read = [&](const std::string& content) {
    return read_signal_table(folder.write("matrix", content));
  };
  const auto entries = [](const SignalTable& table) {
    std::string all;
    for (std::size_t i = 0; i < table.rows(); ++i)
      for (const SignalEntry& entry : table.row(i))
        all += std::to_string(i) + "," + std::to_string(entry.transceiver) + "=" +
               std::to_string(entry.signal) + " ";
    return all;
  };

  SignalTable with_ids = read(csv[0]);
  EXPECT_EQ(with_ids.transceivers[2].id, "north, 3");
  EXPECT_EQ(entries(with_ids), entries(read(csv[1])));
  EXPECT_EQ(entries(read(text[0])), "0,0=0.700000 0,2=0.200000 ");
  EXPECT_EQ(entries(read(text[1])), "0,0=1.000000 0,1=1.000000 1,1=1.000000 1,2=1.000000 ");
  EXPECT_EQ(entries(read(text[1])), entries(read(text[2])));
  for (std::size_t j = 0; j < 3; ++j)
    EXPECT_EQ(read(text[1]).transceivers[j].cost, read(text[2]).transceivers[j].cost);

  apply_costs(with_ids, folder.write("costs", csv[2]));
  apply_costs(with_ids, folder.write("costs", csv[3]));
  EXPECT_EQ(with_ids.transceivers[0].cost, 2.5);
  EXPECT_EQ(with_ids.labels[0].link_cost, 0.1);
  EXPECT_EQ(with_ids.labels[0].signal_cost, 0.01);
  forbid_pairs(with_ids, folder.write("pairs", csv[4]));
  EXPECT_EQ(with_ids.conflicts.size(), 1u);
  apply_weights(with_ids, folder.write("weights", csv[5]));
  EXPECT_EQ(with_ids.labels[0].weight, 2.5);
}

}  // namespace
}  // namespace shelfbeam::test
