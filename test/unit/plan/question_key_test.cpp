#include "shelfbeam/plan/question/question_key.hpp"

#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "unit/scene/sample_store.hpp"

namespace shelfbeam {
namespace {

TEST(QuestionKey, DependsOnEveryPartOfAQuestionAboutAChangingShop) {
  test::Json store = test::sample_store();
  const Scene scene = test::scene_of(store);
  store["variation"] = {{"unit_power_db", 1}};
  const Scene varying = test::scene_of(store);
  const std::vector<double> required{0.95, 0.9}, less{0.95, 0.8};
  const AvailabilityGoal labels, share{AvailabilityRule::labels, 0.0}, shop{AvailabilityRule::shop, 0.9},
      other{AvailabilityRule::shop, 0.91};
  const std::vector<StatesQuestion> questions{
      {scene, labels, required, 0.99, 100}, {varying, labels, required, 0.99, 100},
      {scene, share, required, 0.99, 100},  {scene, shop, required, 0.99, 100},
      {scene, other, required, 0.99, 100},  {scene, labels, less, 0.99, 100},
      {scene, labels, required, 0.95, 100}, {scene, labels, required, 0.99, 101}};
  std::set<std::uint64_t> keys;
  for (const StatesQuestion& question : questions)
    for (const std::uint64_t fixed : {1, 2}) {
      keys.insert(question_key(fixed, question));
      EXPECT_EQ(question_key(fixed, question), question_key(fixed, question));
    }
  EXPECT_EQ(keys.size(), 2 * questions.size());
}

}  // namespace
}  // namespace shelfbeam
