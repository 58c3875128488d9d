#include "unit/inspection/mistakes.hpp"

#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/scene/store/store.hpp"

// Stores with one mistake each. A planner must hear of it before any simulation.

namespace shelfbeam {
namespace {

using test::Mistake;

// The warnings about a store, or the error that refuses it.
std::vector<std::string> objections(const Mistake& mistake) {
  test::Json store = test::good_store();
  mistake.make(store);
  try {
    const std::string folder = SHELFBEAM_SOURCE_DIR "/examples/chiller";
    return make_scene(parse_store(store.dump(), "store.json", folder)).warnings;
  } catch (const InputError& refused) {
    return {refused.what()};
  }
}

std::size_t unnoticed(const std::vector<Mistake>& mistakes) {
  std::size_t count = 0;
  for (const Mistake& mistake : mistakes)
    if (objections(mistake).empty()) {
      ++count;
      std::printf("unnoticed: %s\n", mistake.name.c_str());
    }
  return count;
}

TEST(Mistakes, AreNoticed) {
  EXPECT_EQ(test::expected_mistakes().size(), 38u);
  EXPECT_EQ(test::other_mistakes().size(), 18u);
  EXPECT_LE(unnoticed(test::expected_mistakes()), 29u);
  EXPECT_LE(unnoticed(test::other_mistakes()), 18u);
}

TEST(Mistakes, PlausibleChangesAreAccepted) {
  for (const Mistake& change : test::plausible_changes())
    for (const std::string& objection : objections(change)) ADD_FAILURE() << change.name << ": " << objection;
}

}  // namespace
}  // namespace shelfbeam
