#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/signal/constraints/apart.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

#include "support/temp_folder.hpp"

namespace shelfbeam {
namespace {

using test::TempFolder;

// The fenced blocks of a kind, in the order of the page.
std::vector<std::string> blocks(const std::string& page, const std::string& kind) {
  const std::string open = "```" + kind + "\n", close = "```";
  std::vector<std::string> found;
  for (std::size_t at = page.find(open); at != std::string::npos; at = page.find(open, at)) {
    at += open.size();
    const std::size_t end = page.find(close, at);
    found.push_back(page.substr(at, end - at));
  }
  return found;
}

TEST(Documentation, ExamplesOfTheMatrixFormatsAreRead) {
  const std::string page = read_file(SHELFBEAM_SOURCE_DIR "/docs/formats/matrices.md");
  const auto csv = blocks(page, "csv"), text = blocks(page, "text");
  ASSERT_EQ(csv.size(), 5u);
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
  EXPECT_EQ(with_ids.apart.size(), 1u);
}

}  // namespace
}  // namespace shelfbeam
