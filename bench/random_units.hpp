#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam::bench {

/// Kinds of places for units.
inline constexpr std::array<std::string_view, 4> unit_places{"ceiling", "tilted", "beside walls",
                                                             "between shelves"};

struct PlacedUnit {
  std::size_t place;  ///< index into unit_places
  Transceiver unit;
};

/// Random units of the scene's types, of each kind in turn: within a metre of candidates, straight down or
/// tilted by 30 degrees; 10 to 20 cm beside walls, half a metre below the candidates at most; and between
/// shelves, 1 to 2.2 m above the floor.
std::vector<PlacedUnit> random_units(const World& world, std::size_t count, std::uint64_t seed);

}  // namespace shelfbeam::bench
