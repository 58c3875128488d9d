#pragma once

#include <cstdint>
#include <span>

#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// The same shop with some of its labels and transceivers, in the order given: what is simulated of it
/// follows the same law as in the whole scene, for devices are not in the way of light.
Scene sub_scene(const Scene& scene, std::span<const std::uint32_t> labels,
                std::span<const std::uint32_t> transceivers);

}  // namespace shelfbeam
