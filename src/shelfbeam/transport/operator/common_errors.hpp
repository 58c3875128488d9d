#pragma once

#include <cstdint>
#include <vector>

#include "shelfbeam/transport/operator/label_hits.hpp"
#include "shelfbeam/transport/operator/surface_field.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam {

/// The relative error of the light from cells that the links between cells cause at the labels of each
/// cluster, all together: they have the same bounces before their own rays. It is the root mean square over
/// the labels, for lamps at random places.
std::vector<float> common_errors(const World& world, const SurfaceNodes& nodes,
                                 const std::vector<LabelHits>& clusters, std::uint64_t seed);

}  // namespace shelfbeam
