#include <gtest/gtest.h>

#include "shelfbeam/signal/tables/signal_table.hpp"

#include "support/expect_input_error.hpp"
#include "support/temp_folder.hpp"
#include "unit/signal/small_matrix.hpp"

namespace shelfbeam {
namespace {

using test::TempFolder;

TEST(Costs, OfTransceivers) {
  const TempFolder folder;
  SignalTable table = make_signal_table(test::small_matrix());
  apply_costs(table, folder.write("c.csv", "id,cost\nG1-3-0,7.5\nG1-0-0,0\n"));
  EXPECT_EQ(table.transceivers[3].cost, 7.5);
  EXPECT_EQ(table.transceivers[0].cost, 0);
  EXPECT_EQ(table.transceivers[1].cost, 2) << "not in the file: unchanged";
}

TEST(Costs, OfLabels) {
  const TempFolder folder;
  SignalTable table = make_signal_table(test::small_matrix());
  apply_costs(table, folder.write("c.csv", "id,signal_cost,link_cost\n\"shelf \"\"A\"\", left\",3,4\n"));
  EXPECT_EQ(table.labels[1].signal_cost, 3);
  EXPECT_EQ(table.labels[1].link_cost, 4);
  EXPECT_EQ(table.labels[2].link_cost, 0.5);
  apply_costs(table, folder.write("c.csv", "id,link_cost\nA1-front-2,9\n"));
  EXPECT_EQ(table.labels[2].link_cost, 9);
  EXPECT_EQ(table.labels[2].signal_cost, 1e-3);
}

TEST(Costs, BrokenFilesAreRefusedWithPlace) {
  const TempFolder folder;
  const auto refused = [&](std::string_view content, std::string_view place, std::string_view problem) {
    SignalTable table = make_signal_table(test::small_matrix());
    const auto path = folder.write("c.csv", content);
    test::expect_input_error([&] { apply_costs(table, path); }, path.string(), place, problem);
  };
  refused("", "", "is empty");
  refused("id\nG1-0-0\n", "line 1", "neither a cost file");
  refused("name,cost\nG1-0-0,1\n", "line 1, field 1", "'name'");
  refused("id,price\nG1-0-0,1\n", "line 1, field 2", "'price'");
  refused("id,cost,link_cost\nG1-0-0,1,1\n", "line 1", "neither a cost file");
  refused("id,cost,cost\nG1-0-0,1,1\n", "line 1, field 3", "second column 'cost'");
  refused("id,cost\nG1-0-1,1\n", "line 2, field 1", "did you mean 'G1-0-0'");
  refused("id,cost\nG1-0-0,1\nG1-0-0,1\n", "line 3, field 1", "a second time");
  refused("id,cost\nG1-0-0,-1\n", "line 2, field 2", "negative");
  refused("id,cost\nG1-0-0,nan\n", "line 2, field 2", "NaN");
  refused("id,cost\nG1-0-0,inf\n", "line 2, field 2", "infinite");
  refused("id,cost\nG1-0-0\n", "line 2", "has 1 fields");
}

TEST(Requirement, IsSetOnEveryLabel) {
  SignalTable table = make_signal_table(test::small_matrix());
  set_requirement(table, 0.25);
  for (const auto& label : table.labels) {
    EXPECT_EQ(label.requirement, 0.25);
    EXPECT_EQ(label.single_requirement, 0.25);
  }
}

}  // namespace
}  // namespace shelfbeam
