#pragma once

#include <string>
#include <vector>

#include "system/claims/truth.hpp"

namespace shelfbeam::test {

struct Text {
  std::string text;
  Subject subject = Subject::signals;
};

/// What terminal and page say about a plan.
std::vector<Text> texts_of(const PlannedStore& store);

}  // namespace shelfbeam::test
