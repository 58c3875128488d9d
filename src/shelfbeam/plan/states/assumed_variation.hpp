#pragma once

#include <string>
#include <vector>

#include "shelfbeam/plan/answer/availability.hpp"
#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam {

/// The values of a store's variation that matter for it and that its file does not give.
AssumedVariation assumed_variation(const Store& store);

/// The names of the causes that the file leaves out.
std::vector<std::string> causes_left_out(const Store& store);

}  // namespace shelfbeam
