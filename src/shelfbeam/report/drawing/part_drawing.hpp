#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// CSS class of a part; goods alternate between a few colours from place to place, as products do.
std::string part_class(const Part& part);

/// Parts in plan from the lowest top to the highest, without those that a board of their fixture hides from
/// above.
std::vector<std::uint32_t> parts_seen_from_above(const Scene& scene);

/// CSS rules of `part_class` and of everything else in a stand-alone drawing.
std::string drawing_style();

}  // namespace shelfbeam
