#include "serve/text/json_value.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/json_parser.hpp"

namespace shelfbeam::serve {
namespace {

TEST(JsonValue, EqualsAsJson) {
  EXPECT_TRUE(same_value(1, 1.0));
  EXPECT_TRUE(same_value(1u, 1));
  EXPECT_TRUE(same_value({{"a", 1}, {"b", {2}}}, {{"b", {2.0}}, {"a", 1}}));
  EXPECT_TRUE(same_value(Json::array(), Json::array()));
  EXPECT_FALSE(same_value({1, 2}, {2, 1}));
  EXPECT_FALSE(same_value({{"a", 1}}, {{"b", 1}}));
  EXPECT_FALSE(same_value({{"a", 1}}, {{"a", 1}, {"b", 1}}));
  EXPECT_FALSE(same_value(1, "1"));
  EXPECT_FALSE(same_value(0, false));
  EXPECT_FALSE(same_value(nullptr, false));
  EXPECT_FALSE(same_value(Json::array(), Json::object()));
  EXPECT_FALSE(same_value(std::numeric_limits<std::uint64_t>::max(), -1)) << "the same bits";
}

TEST(JsonValue, NumbersAreShort) {
  const std::pair<double, const char*> cases[] = {{0, "0"},           {-0.0, "0"},
                                                  {1, "1"},           {0.1, "0.1"},
                                                  {-12.5, "-12.5"},   {1e5, "100000"},
                                                  {1e20, "1e20"},     {2.5e-7, "2.5e-7"},
                                                  {1e300, "1e300"},   {0.000125, "0.000125"},
                                                  {5e-324, "5e-324"}, {0.1 + 0.2, "0.30000000000000004"}};
  for (const auto& [value, text] : cases) EXPECT_EQ(scalar_text(value), text);
  EXPECT_EQ(scalar_text(std::numeric_limits<std::int64_t>::min()), "-9223372036854775808");
}

TEST(JsonValue, NumbersReadBackExactly) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20'000; ++i) {
    const std::uint64_t bits = random();
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    const double centimetres = static_cast<double>(bits % 100'000) / 100;
    for (const double number : {value, centimetres})
      ASSERT_EQ(parse_json(scalar_text(number), "number").get<double>(), number) << scalar_text(number);
  }
}

}  // namespace
}  // namespace shelfbeam::serve
