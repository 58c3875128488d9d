#pragma once

#include <optional>
#include <vector>

#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// Labels and units.
struct Devices {
  std::vector<Label> labels;
  std::vector<Transceiver> transceivers;
};

/// Devices between the surfaces of a scene, with those that touch glass moved away from it by `distance`, at
/// which rays can tell on which side they are. A device on a pane, or beyond it by up to `overlap`, is in
/// front of it: it looks away from the pane. A device on solid glass, or in it by up to `overlap`, is
/// outside, in whichever direction it looks. No value if no device touches glass.
std::optional<Devices> devices_off_glass(const Scene& scene, Devices devices, double distance,
                                         double overlap);

}  // namespace shelfbeam
