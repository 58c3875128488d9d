#pragma once

#include <set>
#include <string>

#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam {

/// Marks the installed and the pinned units of a scene, and moves the excluded candidates to
/// Scene::excluded. `sources` are the locations of the scene's devices; `kept_out` are ids of candidates in a
/// `keep_out` area. Throws InputError for an id or a pattern without a candidate, for two units at one
/// mounting point, and if no candidate is left.
void mark_given_units(const Store& store, const std::set<std::string>& kept_out, Scene& scene,
                      DeviceSources& sources);

}  // namespace shelfbeam
