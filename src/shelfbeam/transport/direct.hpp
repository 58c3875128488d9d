#pragma once

#include <cstddef>
#include <span>

#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/transport/emitters.hpp"
#include "shelfbeam/transport/ray_scene.hpp"

namespace shelfbeam {

/// The direct part of one entry in closed form: R(theta) I_j(omega) / d^2 times visibility.
double direct_signal(const Label& label, const Responsivity& responsivity, const Emitters& emitters,
                     std::size_t j, const RayScene& rays);

}  // namespace shelfbeam
