#include "shelfbeam/plan/preview/what_if.hpp"

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/base/error.hpp"

#include "unit/plan/plan_store.hpp"

namespace shelfbeam {
namespace {

WhatIf without(std::vector<std::string> units) {
  WhatIf change;
  change.removed = std::move(units);
  return change;
}

// Two units of a plan: the first gives all labels half of their requirement, the second twice, both with an
// error of a tenth.
class WhatIfOfAPlan : public testing::Test {
 protected:
  WhatIfOfAPlan() {
    UnitsBefore of;
    of.ids = {"A", "C"};
    of.columns = {preview(0.5), preview(2)};
    for (Preview& column : of.columns) column.error.assign(m, static_cast<float>(requirement / 10));
    plan = std::move(of);
  }

  Preview preview(double share) const {
    const auto t = static_cast<float>(requirement);
    return {std::vector<float>(m, static_cast<float>(share) * t), std::vector<float>(m, 0),
            std::vector<float>(m, t / 5), std::vector<std::uint8_t>(m)};
  }

  const Scene scene = test::PlanStore().scene();
  const std::size_t m = scene.labels.size();
  const double requirement = scene.requirement_of(scene.labels[0]);
  std::optional<UnitsBefore> plan;
};

TEST_F(WhatIfOfAPlan, RemovesUnits) {
  const WhatIf result = what_if(scene, plan, without({"C"}), {});
  EXPECT_TRUE(result.has_before);
  EXPECT_EQ(result.lost(), m);
  EXPECT_EQ(result.reached(), 0U);
  EXPECT_NEAR(result.labels[0].before, 2.5 * requirement, 1e-6 * requirement);
  EXPECT_NEAR(result.labels[0].after, 0.5 * requirement, 1e-6 * requirement);
  EXPECT_NEAR(result.labels[0].error, 0.1 * requirement, 1e-6 * requirement);
  EXPECT_THROW(what_if(scene, plan, without({"B"}), {}), InputError) << "not in the plan";
  EXPECT_THROW(what_if(scene, plan, without({"C", "C"}), {}), InputError);
}

TEST_F(WhatIfOfAPlan, AddsErrorsOfSums) {
  Preview added = preview(0.6);
  added.doubts[3] = static_cast<std::uint8_t>(Doubt::mirrors);
  const WhatIf result = what_if(scene, plan, without({"C"}), std::vector{added});
  EXPECT_EQ(result.gained() + result.lost(), 0U);
  EXPECT_EQ(result.doubtful(), 1U);
  EXPECT_NEAR(result.labels[0].margin(), 1.1, 1e-6);
  EXPECT_NEAR(result.labels[0].error, std::hypot(0.1, 0.2) * requirement, 1e-6 * requirement);
  EXPECT_EQ(result.close(), m) << "0.1 is less than 1.96 errors of 0.22";
}

TEST_F(WhatIfOfAPlan, TakesTheStrongestUnitWithoutCooperation) {
  plan->problem.model = CommunicationModel::non_cooperative;
  const WhatIf result = what_if(scene, plan, {}, std::vector{preview(1.5)});
  EXPECT_NEAR(result.labels[0].before, 2 * requirement, 1e-6 * requirement);
  EXPECT_NEAR(result.labels[0].after, 2 * requirement, 1e-6 * requirement);
  EXPECT_NEAR(result.labels[0].error, 0.1 * requirement, 1e-6 * requirement) << "of the strongest";
}

TEST_F(WhatIfOfAPlan, SurvivesTheFailureOfTheStrongestUnit) {
  plan->problem.redundant = true;
  const WhatIf result = what_if(scene, plan, {}, std::vector{preview(0.7)});
  EXPECT_EQ(result.gained(), m);
  EXPECT_NEAR(result.labels[0].after, 1.2 * requirement, 1e-6 * requirement);
  EXPECT_NEAR(result.labels[0].error, std::hypot(0.1, 0.2) * requirement, 1e-6 * requirement);
  plan->problem.model = CommunicationModel::non_cooperative;
  const WhatIf alone = what_if(scene, plan, {}, std::vector{preview(0.7)});
  EXPECT_NEAR(alone.labels[0].after, 0.7 * requirement, 1e-6 * requirement) << "of the second";
  EXPECT_NEAR(alone.labels[0].error, 0.2 * requirement, 1e-6 * requirement);
}

TEST(WhatIf, CountsFromNothingWithoutAPlan) {
  const Scene scene = test::PlanStore().scene();
  const std::size_t m = scene.labels.size();
  Preview added{std::vector<float>(m, 0), std::vector<float>(m, 0), std::vector<float>(m, 0),
                std::vector<std::uint8_t>(m)};
  added.signal[2] = 1;
  const WhatIf result = what_if(scene, {}, {}, std::vector{added});
  EXPECT_FALSE(result.has_before);
  EXPECT_EQ(result.reached(), 1U);
  EXPECT_EQ(result.weakest().back(), 2U);
  EXPECT_THROW(what_if(scene, {}, without({"T0-0"}), {}), InputError);
}

}  // namespace
}  // namespace shelfbeam
