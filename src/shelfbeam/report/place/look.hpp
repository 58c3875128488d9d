#pragma once

#include <vector>

#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// How a fixture looks in plan, so that a drawing of it hides nothing.
enum class Look {
  solid,     ///< stands on the floor
  covering,  ///< surrounds other fixtures or much of the floor: transparent
  overhead   ///< above head height, such as a lowered ceiling: its outline only
};

inline constexpr double head_height = 1.9;  ///< m

/// Per fixture.
std::vector<Look> looks_of(const Scene& scene);

}  // namespace shelfbeam
