#pragma once

#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam {

/// Completes Label::place of the labels of a scene whose place is not known, from their positions: the
/// nearest edge or fixture within half a metre, otherwise a wall within 15 cm. Labels in mid-air keep an
/// unknown place.
void find_label_places(const Store& store, Scene& scene);

}  // namespace shelfbeam
