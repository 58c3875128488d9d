#pragma once

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/device/emission.hpp"
#include "shelfbeam/scene/store_folder.hpp"

namespace shelfbeam {

/// Reads the `emission` of a transceiver type, and the photometric file it names, relative to `folder`. Its
/// power is positive. Throws InputError at the JSON path, or in the photometric file at the line.
Emission read_emission(const JsonCursor& cursor, const StoreFolder& folder);

}  // namespace shelfbeam
