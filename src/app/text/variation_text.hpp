#pragma once

#include <string>
#include <vector>

#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam::app {

/// The variation of a store, one line per part; values that the file does not give are marked. Empty without
/// variation.
std::vector<std::string> variation_lines(const Store& store);

}  // namespace shelfbeam::app
