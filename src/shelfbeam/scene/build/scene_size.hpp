#pragma once

#include <cstddef>

#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam {

// Bytes that a part of the store takes in a scene, about: what a few characters of a store file can ask for.

std::size_t scene_size(const Fixture& fixture);
std::size_t scene_size(const TransceiverGrid& grid);

}  // namespace shelfbeam
