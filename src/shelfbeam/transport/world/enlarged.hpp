#pragma once

#include <optional>

#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// A scene smaller than a metre, so many times as large that it has some, with all intensities times the
/// square of that: every signal is the same, (2.14) being a sum of I cos cos / d^2 over surfaces in units of
/// d^2. The factor is a power of two, so nothing is rounded. Nothing where the scene is a metre large.
///
/// What estimators choose for stores, the half-metre cells of the radiance cache among it, then serves a box
/// of millimetres as well.
std::optional<Scene> enlarged(const Scene& scene);

}  // namespace shelfbeam
