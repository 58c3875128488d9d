#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam {

/// Labels with the same surroundings, ascending; no label is in two clusters.
using LabelCluster = std::vector<LabelId>;

/// Groups the given labels by position and normal: the two sides of an aisle, whose labels face each other,
/// belong together; the two faces of a shelf do not. A cluster has at most `most` labels. The first label
/// sees all others, from eye to eye: an eye is a point in front of a label.
std::vector<LabelCluster> cluster_labels(const World& world, std::span<const LabelId> labels,
                                         std::size_t most);

}  // namespace shelfbeam
