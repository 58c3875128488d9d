#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/plan/states/fresh_states.hpp"

namespace shelfbeam {
namespace {

// The states that are shown if state k of the round misses the labels 0 to missed[k] - 1.
std::vector<ShownState> shown(const std::vector<std::uint32_t>& missed) {
  const FreshStatesOptions options{
      .round = 2, .looks = {static_cast<std::uint32_t>(missed.size())}, .ends_early = false};
  const auto labels_of = [&](std::uint64_t k) {
    std::vector<LabelId> labels(missed.at(k - first_fresh_state(0, 2)));
    for (std::uint32_t i = 0; i < labels.size(); ++i) labels[i] = i;
    return labels;
  };
  return examine(labels_of, {}, std::vector<double>(9, 0.9), options, Deadline(HUGE_VAL), {}).shown;
}

std::vector<std::uint64_t> numbers(const std::vector<ShownState>& states) {
  std::vector<std::uint64_t> numbers;
  numbers.reserve(states.size());
  for (const ShownState& state : states) numbers.push_back(state.number - first_fresh_state(0, 2));
  return numbers;
}

TEST(ShownStates, AreTheFirstAndTheWorst) {
  const auto states = shown({0, 2, 0, 1, 2, 3, 0, 5, 4, 5});
  EXPECT_EQ(numbers(states), (std::vector<std::uint64_t>{0, 1, 2, 3, 7}));
  EXPECT_EQ(states[1].missed, (std::vector<LabelId>{0, 1}));
  EXPECT_EQ(states[4].missed.size(), 5U);
}

TEST(ShownStates, AreFewerIfTheWorstIsAmongTheFirst) {
  EXPECT_EQ(numbers(shown({0, 0, 0, 0, 0, 0})), (std::vector<std::uint64_t>{0, 1, 2, 3}));
  EXPECT_EQ(numbers(shown({0, 4, 0, 0, 0, 4})), (std::vector<std::uint64_t>{0, 1, 2, 3}));
  EXPECT_EQ(numbers(shown({0, 4, 0})), (std::vector<std::uint64_t>{0, 1, 2}));
}

}  // namespace
}  // namespace shelfbeam
