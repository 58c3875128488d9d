#pragma once

#include <cstdint>

#include <nlohmann/json_fwd.hpp>

#include "shelfbeam/report/viewer/page_data.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// Adds the shop for a 3-D view: room and parts of fixtures. Returns its corners as "lower" and "upper".
/// Positions are in m in single precision. `has_states`: the doors are those of fixtures that a state may
/// open.
nlohmann::ordered_json add_scene(PageData& page, const Scene& scene, bool has_states);

}  // namespace shelfbeam
