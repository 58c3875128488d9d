#pragma once

#include "support/temp_folder.hpp"

namespace shelfbeam::fuzz {

/// A temporary folder of this process for readers that take a path; removed when the process ends.
inline const test::TempFolder& scratch() {
  static const test::TempFolder folder;
  return folder;
}

}  // namespace shelfbeam::fuzz
