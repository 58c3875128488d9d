#include "sample.hpp"

#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "shelfbeam/base/error.hpp"

namespace shelfbeam::fuzz {
namespace {

constexpr std::uint64_t seed = 1;

std::vector<std::string> planted_seeds() {
  return {"count 12, then more text"};
}

// Behaves like a reader with an error of its own behind one bit.
void fails_beyond_limits(std::string_view bytes) {
  if (bytes.find("count -1") != std::string_view::npos) throw std::length_error("vector::reserve");
  if (!bytes.starts_with("count")) throw InputError("file", "has no count");
}

void refuses_changes(std::string_view bytes) {
  if (bytes != planted_seeds().front()) throw InputError("file", "was changed");
}

TEST(FuzzSample, NoticesAPlantedMistake) {
  const Sample found = sample({"planted", fails_beyond_limits, planted_seeds}, 5000, seed);
  EXPECT_EQ(found.finding, "vector::reserve");
  EXPECT_NE(found.input.find("count -1"), std::string::npos);
}

TEST(FuzzSample, NoticesAReaderThatTakesTooLong) {
  const auto ends = [](std::string_view) {};
  EXPECT_NE(sample({"planted", ends, planted_seeds}, 0, seed, -1).finding, "");
}

TEST(FuzzSample, TakesARefusalForAnAnswer) {
  const Sample found = sample({"planted", refuses_changes, planted_seeds}, 500, seed);
  EXPECT_EQ(found.finding, "");
  EXPECT_EQ(found.inputs, 501u);
  EXPECT_GE(found.read, 1u) << "the seed itself";
  EXPECT_LT(found.read, 50u) << "few changes change nothing";
}

class SlowFuzz : public testing::TestWithParam<Reader> {};

TEST_P(SlowFuzz, AChangedFileIsReadOrRefused) {
  const Sample found = sample(GetParam(), 800, seed);
  EXPECT_EQ(found.finding, "") << "after " << found.inputs << " inputs, of:\n" << found.input;
  EXPECT_GE(found.read, 1u) << "not even a seed is read";
}

INSTANTIATE_TEST_SUITE_P(, SlowFuzz, testing::ValuesIn(readers().begin(), readers().end()),
                         [](const auto& reader) { return std::string(reader.param.name); });

}  // namespace
}  // namespace shelfbeam::fuzz
