#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam {

// Units to be examined: of a placement.json, which selects candidates of a store, of a CSV of mounted units
// (docs/formats/store/csv.md), which replace them, or, without a file, those that the store chooses.

/// Whether the file is a placement.json, by its first character.
bool is_placement_file(const std::filesystem::path& file);

/// The store with the units of a CSV as its only candidates; otherwise the store.
Store with_candidates_of(const std::filesystem::path& file, Store store);

/// The numbers of the units that the store chooses (Transceiver::is_chosen).
std::vector<ColumnId> chosen_units(const Scene& scene);

/// The selection and the problem of a placement.json; all units of the scene for a CSV; the chosen ones
/// (Transceiver::is_chosen) without a file. Throws InputError if no unit is selected; `store` is its name.
Placement given_units(const std::filesystem::path& file, const Scene& scene,
                      const std::filesystem::path& store);

}  // namespace shelfbeam
