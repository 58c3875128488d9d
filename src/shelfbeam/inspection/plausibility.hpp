#pragma once

#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam {

/// The scene of a store (make_scene) with warnings about values that a simulation accepts, but that are
/// hardly intended: requirements that every unit or no unit meets, labels in mid-air, units aimed at a wall,
/// fixtures inside one another. Each warning names the place in the store file, the value, the usual value
/// and a remedy. docs/formats/store/warnings.md lists the checks. Throws InputError as make_scene does,
/// and Interrupted.
Scene make_inspected_scene(const Store& store);

}  // namespace shelfbeam
