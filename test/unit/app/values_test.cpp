#include "app/options/values.hpp"

#include "support/testing.hpp"

namespace shelfbeam::app {
namespace {

using testing::HasSubstr;

// The number as the program reads it, or the error.
std::string read(const Shares& shares, std::string text) {
  const std::string error = a_share("", shares)(text);
  return error.empty() ? text : error;
}

constexpr Shares confidence{0.5, 0.999999, true, true}, relative{0, 1, false};

TEST(Share, IsANumberOrInPercent) {
  for (const char* text : {"0.99", "99%", "99 %", " 99% ", "99", "+99", "9.9e1", "0.99e2"})
    EXPECT_EQ(read(confidence, text), "0.99") << text;
  EXPECT_EQ(read(confidence, "99.9"), "0.999");  // not 99.9 / 100 with its rounding error
  EXPECT_EQ(read(confidence, "50"), "0.5");
  EXPECT_EQ(read(relative, "5%"), "0.05");
  EXPECT_EQ(read(relative, "1"), "1");
  EXPECT_EQ(read(any_share, "250%"), "2.5");
}

TEST(Share, ErrorsShowTheRightForm) {
  for (const char* text : {"1", "1.5", "0.4", "100", "99.99999", "-1", "40%", "0.99%"})
    EXPECT_THAT(read(confidence, text),
                HasSubstr("' is not a share from 0.5 to 0.999999, such as 0.99 or 99%"))
        << text;
  for (const char* text : {"", "%", "nan", "inf", "five", "5%%", "0.99x"})
    EXPECT_THAT(read(confidence, text), HasSubstr("' is not a share such as 0.05 or 5%")) << text;
  EXPECT_EQ(read(relative, "5"), "'5' is not a share above 0, at most 1; for 5 percent, give 0.05 or 5%");
  EXPECT_EQ(read(relative, "0"), "'0' is not a share above 0, at most 1");
  EXPECT_EQ(read(any_share, "5"), "'5' can mean 5 or 500 percent; give 5% or 500%");
  EXPECT_EQ(read(any_share, "0"), "'0' is not a share above 0");
}

TEST(Values, AreChecked) {
  EXPECT_EQ(positive_number("")("1e-3"), "");
  for (const char* text : {"0", "-1", "inf", "nan", "1,5", "", "1x"})
    EXPECT_NE(positive_number("")(text), "") << text;
  EXPECT_EQ(number_from_zero("")("0"), "");
  EXPECT_NE(number_from_zero("")("-0.1"), "");
  EXPECT_EQ(whole_number("", 1, 9)("9"), "");
  for (const char* text : {"0", "10", "1.5", "1e0", "-1", ""})
    EXPECT_EQ(whole_number("", 1, 9)(text), "'" + std::string(text) + "' is not a whole number from 1 to 9");
  EXPECT_NE(whole_number("", 0)("18446744073709551616"), "");
  std::string size = "4G";
  EXPECT_EQ(size_in_bytes()(size), "");
  EXPECT_EQ(size, "4000000000");
  for (std::string text : {"4X", "G", "0", "-1G"})
    EXPECT_THAT(size_in_bytes()(text), HasSubstr("' is not a size such as 4G or 500M"));
}

}  // namespace
}  // namespace shelfbeam::app
