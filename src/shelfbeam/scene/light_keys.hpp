#pragma once

#include <cstdint>
#include <span>
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

/// LightKeys::transceivers of units with the types of the scene.
std::vector<std::uint64_t> light_keys_of(const Scene& scene, std::span<const Transceiver> units);

}  // namespace shelfbeam
