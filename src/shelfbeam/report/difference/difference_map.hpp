#pragma once

#include <string>

#include "shelfbeam/report/messages/difference.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// The floor plan of the second shop with the units of both plans and the labels gained and lost, as a
/// <figure>.
std::string difference_map(const DifferenceInput& input, const Scene& after);

}  // namespace shelfbeam
