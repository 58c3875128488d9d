#include "shelfbeam/transport/run/error_survey.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "physics/bare_scene.hpp"

namespace shelfbeam {
namespace {

using detail::AnalyticDirect;

/// One label and two units; the test sets `sums`.
class OneRow : public Estimator {
 public:
  std::size_t items() const override { return 1; }
  const Block& block(std::size_t) const override { return block_; }
  std::uint64_t samples_per_batch() const override { return 100; }
  bool samples_direct() const override { return true; }
  std::string name() const override { return "one row"; }
  bool sample(std::size_t, std::uint32_t, const CancelToken*, BatchValues&) const override { return true; }

  std::unique_ptr<Estimator> part(std::span<const LabelId>, std::uint64_t, std::uint64_t) const override {
    return nullptr;
  }
  std::unique_ptr<Estimator> for_state(const World&, std::uint64_t) const override { return nullptr; }

 private:
  Block block_{{0}, {0, 1}};
};

struct Surveyed {
  Precision precision;
  ErrorSurvey::Shortfall shortfall;
};

// The first unit's contributions are nearly constant; only one batch finds the second.
Surveyed survey(std::uint32_t batches, const RelativeError& wanted) {
  test::BareScene room;
  room.box(room.material(Lambertian{0.5}), {0, 0, 0}, {4, 4, 3});
  room.label({2, 2, 1}, {0, 0, 1});
  room.unit({1, 1, 2.9}, {0, 0, -1}, SinTwoTheta{1});
  room.unit({3, 3, 2.9}, {0, 0, -1}, SinTwoTheta{1});
  const World world(room.scene);
  const OneRow estimator;
  std::vector<ItemSums> sums(1, ItemSums(2, false, 0));
  for (std::uint32_t b = 0; b < batches; ++b) {
    BatchValues values;
    values.values.push_back({0, b % 2 == 0 ? 0.9 : 1.1});
    if (b == 0) values.values.push_back({1, static_cast<double>(batches)});
    sums[0].add(values);
  }
  const AnalyticDirect known(world, {.samples_direct = true}, RunControl{});
  const ErrorSurvey found(world, estimator, sums, known);
  return {found.precision(0, wanted), found.shortfall(wanted, 10)};
}

// A flagged entry never counts as precise, however large the target error. Before 1,024 batches more of them
// may help; after that the error cannot be reached.
TEST(ErrorSurvey, LimitsSamplesForFlaggedEntries) {
  for (const std::uint32_t batches : {last_flagged_batches - 1, last_flagged_batches}) {
    const bool is_final = batches == last_flagged_batches;
    const auto [precision, shortfall] = survey(batches, {2, 0.3, 1'000'000'000});
    EXPECT_EQ(precision.relevant, 2U);
    EXPECT_EQ(precision.precise, 1U);
    EXPECT_EQ(precision.unreachable, is_final ? 1U : 0U);
    EXPECT_EQ(shortfall.precision.relevant, 2U);
    EXPECT_EQ(shortfall.precision.precise, 1U);
    EXPECT_EQ(shortfall.precision.unreachable, is_final ? 1U : 0U);
    ASSERT_EQ(shortfall.worst.size(), 1U);
    EXPECT_EQ(shortfall.worst[0].source, "T1");
    EXPECT_TRUE(shortfall.worst[0].is_flagged);
    EXPECT_EQ(shortfall.worst[0].is_out_of_reach, is_final);
  }
}

// Entries that more samples would improve are listed separately from the others, which are named last.
TEST(ErrorSurvey, PredictsTheEffectOfMoreSamples) {
  const auto [precision, shortfall] = survey(64, {0.01, 0.3, 12'800});  // 1.2 % so far; twice the samples
  EXPECT_EQ(precision.precise, 0U);
  EXPECT_EQ(precision.unreachable, 1U);
  EXPECT_EQ(shortfall.precision.unreachable, 1U);
  ASSERT_EQ(shortfall.worst.size(), 2U);
  EXPECT_EQ(shortfall.worst[0].source, "T1");
  EXPECT_FALSE(shortfall.worst[1].is_out_of_reach);
  EXPECT_NEAR(shortfall.worst[1].relative_error, 0.1 / 8, 2e-4);
}

}  // namespace
}  // namespace shelfbeam
