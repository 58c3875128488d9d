#include <gtest/gtest.h>

#include "shelfbeam/base/file.hpp"

#include "support/expect_input_error.hpp"

namespace shelfbeam {
namespace {

TEST(FormatVersion, OfTheProgramAloneIsAccepted) {
  EXPECT_NO_THROW(expect_format_version("a.file", 3, 3));
  test::expect_input_error([] { expect_format_version("a.file", 4, 3); }, "a.file: ", "4", "newer");
  test::expect_input_error([] { expect_format_version("a.file", 2, 3); }, "a.file: ", "2", "wrote it");
}

}  // namespace
}  // namespace shelfbeam
