#include "shelfbeam/report/messages/reasons.hpp"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace shelfbeam {
namespace {

// Four labels: four units are enough for the shop as given, and a plan with six is certified.
struct Shop {
  Shop() {
    placement.selected = {0, 1, 2, 3, 4, 5};
    found.required = {0.95, 0.95, 0.95, 0.95};
    found.nominal = {4, 100, {50, 100, 0, 0}, 100};
    found.nominal_bound = 4;
    found.sample = found.nominal;
    found.examined = {{6, 300, {0, 0, 0, 0}, 0}};
    found.certified = true;
    found.lower_bound = 5;
    found.alone = {{"reflectance", {1}, 1, 5, 5, {}},
                   {"people", {0, 1}, 100, 6, 4, {}},
                   {"mounting", {}, 100, 4, 0, {}}};
  }
  std::vector<std::string> cells() const {
    std::vector<std::string> rows;
    for (const ReasonRow& row : reason_rows(english(), found, placement))
      rows.push_back(row.change + "|" + row.taken + "|" + row.units);
    return rows;
  }
  std::string advice() const { return states_recommendation(english(), found, placement); }

  Placement placement;
  Availability found;
};

TEST(Reasons, AreRowsBetweenBothPlans) {
  Shop shop;
  EXPECT_EQ(shop.cells(), (std::vector<std::string>{"none: the shop as in the store file|0|4",
                                                    "dark surfaces|1|5", "people|2|6 (at least 4)",
                                                    "mounting|0|4", "all together|2|6 (at least 5)"}));
  shop.found.alone[0].unreachable = {1};
  shop.found.alone[1].units = 0;
  shop.found.alone[2].lower_bound = std::numeric_limits<double>::infinity();
  const std::vector<std::string> rows = shop.cells();
  EXPECT_EQ(rows[1], "dark surfaces|1|1 label out of reach");
  EXPECT_EQ(rows[2], "people|2|–");
  EXPECT_EQ(rows[3], "mounting|0|not possible");
}

TEST(Reasons, RecommendOnePlan) {
  Shop shop;
  EXPECT_EQ(
      shop.advice(),
      "Recommended: this plan, 6 transceivers. The 4 that are enough for the shop as in the store file would "
      "reach 2 labels too rarely when the shop changes. Labels that one change alone takes: people 2 labels, "
      "dark surfaces 1.");
  shop.found.nominal.missed = {50, 100, 6, 5};
  EXPECT_TRUE(shop.advice().ends_with("1. 1 more label is lost only to several changes together."));
  for (CauseAlone& cause : shop.found.alone) cause.taken.clear();
  EXPECT_TRUE(shop.advice().ends_with("No change alone takes any; only several together do."));
  shop.found.certified = false;
  EXPECT_TRUE(
      shop.advice().starts_with("Recommended: this plan, 6 transceivers, although it is not confirmed."));
  shop.found.nominal.missed = {0, 0, 0, 0};
  EXPECT_TRUE(shop.advice().ends_with("would be enough in the simulated states, too."));
  shop.found.unreachable = {1};
  EXPECT_EQ(shop.advice(), "");
}

TEST(Reasons, NameLostLabelsWithTheirCause) {
  Shop shop;
  const auto name = [](std::uint32_t label) { return "L" + std::to_string(label); };
  EXPECT_EQ(lost_sentence(english(), shop.found, name), "");
  shop.found.lost = {{1, {"reflectance", "stock"}}, {3, {}}};
  EXPECT_EQ(lost_sentence(english(), shop.found, name),
            "Missed in every state: L1 (dark surfaces or stock), L3 (several changes together).");
  EXPECT_EQ(cause_of_loss(english(), shop.found, 0), "");
}

}  // namespace
}  // namespace shelfbeam
