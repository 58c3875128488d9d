#pragma once

#include <optional>

#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// A scene whose smooth coats are slightly rough on all triangles outside of plane mirrors (PlaneMirrors), as
/// on a curved mesh: no path connects two points over a smooth coat there, so points would lose the light
/// that this coat reflects first. Rough coats are further materials at the end. No value for a scene without
/// such triangles. Emitting surfaces remain as they are.
std::optional<Scene> with_rough_coats(const Scene& scene);

}  // namespace shelfbeam
