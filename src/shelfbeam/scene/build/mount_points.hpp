#pragma once

#include <functional>
#include <string>

#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam {

/// Calls `use(unit, where)` for the candidates of areas, rails and faces of a store whose scene has its room
/// and its fixtures. Points of areas and faces outside the room and within inner walls are omitted.
void generate_candidates(const Store& store, const Scene& scene,
                         const std::function<void(const Transceiver&, const std::string&)>& use);

}  // namespace shelfbeam
