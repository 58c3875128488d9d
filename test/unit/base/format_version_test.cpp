#include "shelfbeam/base/format_version.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shelfbeam/base/error.hpp"

namespace shelfbeam {
namespace {

std::string message(std::int64_t found, std::int64_t known) {
  try {
    expect_format_version("a.file", found, known);
    return "accepted";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(FormatVersion, OfTheProgramIsAccepted) {
  EXPECT_EQ(message(3, 3), "accepted");
}

TEST(FormatVersion, OfAnotherProgramIsRefusedWithWhatToDo) {
  using testing::HasSubstr;
  EXPECT_THAT(message(4, 3),
              HasSubstr("a.file: is of format version 4, this program reads 3; use a newer version"));
  EXPECT_THAT(message(2, 3), HasSubstr("use the version of shelfbeam that wrote it"));
}

}  // namespace
}  // namespace shelfbeam
