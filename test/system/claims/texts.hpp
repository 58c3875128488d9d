#pragma once

#include <string>
#include <vector>

#include "system/claims/truth.hpp"

namespace shelfbeam::test {

struct Text {
  std::string text;
  Subject subject = Subject::signals;
};

/// The sentences of terminal and page about a plan.
std::vector<Text> texts_of(const PlannedStore& store);

}  // namespace shelfbeam::test
