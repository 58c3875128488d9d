#include "shelfbeam/report/mounting/tolerance.hpp"

#include <numbers>

#include "unit/report/shops.hpp"

namespace shelfbeam::test {
namespace {

// A supermarket whose labels have the share of their requirement, so that there is room.
struct Relaxed : Supermarket {
  explicit Relaxed(double share) {
    for (LabelRow& label : matrix.labels) label.requirement *= share;
  }
  std::vector<double> tolerances() const { return tolerances_of(input); }
};

// The labels that the units reach, and miss if each is off by up to `factor` times its tolerance.
std::size_t lost(Relaxed& shop, double factor, unsigned seed) {
  const std::vector<double> tolerances = shop.tolerances();
  const Outcome before = outcome_of(shop.matrix, shop.placement);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi);
  Scene moved = shop.scene;
  for (std::size_t k = 0; k < tolerances.size(); ++k) {
    Vec3& p = moved.transceivers[shop.placement.selected[k]].position;
    const double towards = angle(random);
    p.x += factor * tolerances[k] * std::cos(towards);
    p.y += factor * tolerances[k] * std::sin(towards);
  }
  SignalMatrix after = matrix_of(moved);
  for (std::size_t i = 0; i < after.rows(); ++i)
    after.labels[i].requirement = shop.matrix.labels[i].requirement;
  const Outcome outcome = outcome_of(after, shop.placement);
  std::size_t count = 0;
  for (std::size_t i = 0; i < outcome.labels.size(); ++i)
    if (before.labels[i].met && !outcome.labels[i].met) ++count;
  return count;
}

std::size_t count_of_known(const std::vector<double>& tolerances) {
  return static_cast<std::size_t>(
      std::count_if(tolerances.begin(), tolerances.end(), [](double t) { return t > 0; }));
}

TEST(Tolerance, LosesNoLabelWhereverAllUnitsAreWithinIt) {
  Relaxed shop(0.6);
  ASSERT_GE(count_of_known(shop.tolerances()), 2U);
  for (unsigned seed = 1; seed <= 20; ++seed) EXPECT_EQ(lost(shop, 1, seed), 0U) << seed;
  std::size_t beyond = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) beyond += lost(shop, 12, seed);
  EXPECT_GT(beyond, 0U) << "the control: far beyond it, labels are lost";
}

TEST(Tolerance, IsUnknownWithoutReserve) {
  Relaxed shop(1);
  const Outcome outcome = outcome_of(shop.matrix, shop.placement);
  for (std::size_t i = 0; i < shop.matrix.rows(); ++i)
    shop.matrix.labels[i].requirement = outcome.labels[i].signal;
  EXPECT_EQ(count_of_known(shop.tolerances()), 0U);
}

TEST(Tolerance, GrowsWithTheReserve) {
  const std::vector<double> little = Relaxed(0.9).tolerances(), much = Relaxed(0.4).tolerances();
  double sum = 0;
  for (std::size_t k = 0; k < little.size(); ++k) sum += much[k] - little[k];
  EXPECT_GT(sum, 0);
}

TEST(Tolerance, IsUnknownWithoutNeighboursOnAllSides) {
  Relaxed shop(0.4);
  const std::vector<double> before = shop.tolerances();
  const auto known = std::find_if(before.begin(), before.end(), [](double t) { return t > 0; });
  ASSERT_NE(known, before.end());
  const auto k = static_cast<std::size_t>(known - before.begin());
  const Vec3 at = shop.matrix.transceivers[shop.placement.selected[k]].position;
  for (TransceiverColumn& other : shop.matrix.transceivers)
    if (other.position.x > at.x + 0.1 && std::abs(other.position.y - at.y) < 0.1) other.type = "other";
  EXPECT_EQ(shop.tolerances()[k], 0);
}

TEST(Tolerance, IsUnknownForInstalledUnitsAndChangingShops) {
  Relaxed shop(0.4);
  shop.matrix.transceivers[shop.placement.selected[0]].installed = true;
  EXPECT_EQ(shop.tolerances()[0], 0);
  shop.plan.availability.emplace();
  EXPECT_EQ(count_of_known(shop.tolerances()), 0U);
}

}  // namespace
}  // namespace shelfbeam::test
