#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// Identifies, by value, everything in a scene on which its signals depend. Names, prices, requirements (with
/// the relative sensitivities, which divide these) and the materials that no surface has do not matter.
struct LightKeys {
  std::string light_hash;                   ///< of surfaces, their materials, and the wavelength
  std::vector<std::uint64_t> labels;        ///< position, normal, size and responsivity
  std::vector<std::uint64_t> transceivers;  ///< position, axis, roll, radius, emission and power
};

LightKeys light_keys(const Scene& scene);

}  // namespace shelfbeam
