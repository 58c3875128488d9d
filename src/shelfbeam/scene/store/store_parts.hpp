#pragma once

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/device/emission.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/scene/store_folder.hpp"
#include "shelfbeam/scene/store_names.hpp"

namespace shelfbeam {

// The sections of a store file; each reads one and throws InputError with its JSON path.

void read_transceiver_types(const JsonCursor& section, const StoreFolder& folder, Store& store);
/// The `emission` of a transceiver type, and the photometric file it names; its power is positive. Throws at
/// the JSON path, or in the photometric file at the line.
Emission read_emission(const JsonCursor& cursor, const StoreFolder& folder);
/// After the transceiver types, which a threshold may name.
void read_label_types(const JsonCursor& section, Store& store);
void read_labels(const JsonCursor& section, const StoreNames& names, const StoreFolder& folder, Store& store);
void read_transceivers(const JsonCursor& section, const StoreNames& names, const StoreFolder& folder,
                       Store& store);

}  // namespace shelfbeam
