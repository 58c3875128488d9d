#pragma once

#include <string>
#include <string_view>

#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// The unit that a text describes: "x,y,z", then its axis as three numbers if it does not look straight down,
/// then its type if the candidates of the scene have several. Throws InputError that quotes the text.
Transceiver given_unit(std::string_view text, const Scene& scene, std::string id);

struct MovedUnit {
  std::string id;  ///< of the unit that it replaces
  Transceiver unit;
};

/// A unit of the scene at another place: "ID,x,y,z", then axis and type if they change. It keeps its roll and
/// power. Throws InputError that quotes the text.
MovedUnit moved_unit(std::string_view text, const Scene& scene);

}  // namespace shelfbeam
