#pragma once

#include <filesystem>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam {

// Files with units to be examined: a placement.json, which selects candidates of a store, or a CSV of mounted
// units (docs/formats/store/csv.md), which replace them.

/// Whether the file is a placement.json, by its first character.
bool is_placement_file(const std::filesystem::path& file);

/// The store with the units of a CSV as its only candidates; for a placement.json, the store.
Store with_candidates_of(const std::filesystem::path& file, Store store);

/// The selection and the problem of a placement.json; for a CSV, all units of the scene. Throws InputError if
/// no unit is selected.
Placement given_units(const std::filesystem::path& file, const Scene& scene);

}  // namespace shelfbeam
