#pragma once

#include <filesystem>

#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam {

/// The store's scene with the units of a CSV (device_csv.hpp: read_transceivers_csv) in the place of its
/// candidates; they may hang anywhere, several at one place, too. Throws InputError with file and line.
Scene scene_with_units(Store store, const std::filesystem::path& csv);

}  // namespace shelfbeam
