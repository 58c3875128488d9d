#pragma once

#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "shelfbeam/base/file.hpp"

namespace shelfbeam::test {

/// Expects the text of a file in test/data; writes the file instead where SHELFBEAM_UPDATE_SNAPSHOTS is set.
inline void expect_snapshot(const std::string& text, const std::string& name) {
  const std::string path = SHELFBEAM_SOURCE_DIR "/test/data/" + name;
  if (std::getenv("SHELFBEAM_UPDATE_SNAPSHOTS") != nullptr) write_file(path, text);
  EXPECT_EQ(text, read_file(path)) << "SHELFBEAM_UPDATE_SNAPSHOTS=1 accepts the new text";
}

}  // namespace shelfbeam::test
