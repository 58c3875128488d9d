#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam {

/// Labels that look upon the same surroundings, ascending; no label is in two clusters.
using LabelCluster = std::vector<std::uint32_t>;

/// Groups labels by position and normal: the two sides of an aisle, whose labels face each other, belong
/// together, the two faces of a shelf do not. A cluster holds at most `most` labels, and only such as see, a
/// step out from the shelf, a common point: the same of its first label.
std::vector<LabelCluster> cluster_labels(const World& world, std::size_t most);

}  // namespace shelfbeam
