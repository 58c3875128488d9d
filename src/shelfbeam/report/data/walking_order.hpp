#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

/// A short way past all positions in plan, as indices: it begins at the position nearest to `start`, goes to
/// the nearest one next, and is then shortened by reversing parts of it (2-opt) until no reversal helps.
/// Equal distances are decided by the order of the positions.
std::vector<std::size_t> walking_order(std::span<const Vec3> positions, const Vec3& start = {});

}  // namespace shelfbeam
