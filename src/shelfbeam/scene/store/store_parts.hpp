#pragma once

#include <filesystem>

#include "shelfbeam/base/fields/problems.hpp"
#include "shelfbeam/base/json.hpp"
#include "shelfbeam/device/emission.hpp"
#include "shelfbeam/scene/store/presets.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/scene/store_folder.hpp"
#include "shelfbeam/scene/store_names.hpp"

namespace shelfbeam {

// Readers of the sections of a store file. They throw InputError with the JSON path.

void read_transceiver_types(const JsonCursor& section, const StoreFolder& folder, Store& store);
/// Requires the transceiver types to be read already, because a threshold may name them.
void read_label_types(const JsonCursor& section, Store& store);
/// Completes presets, expands repeats, and places fixtures against walls and others. Requires the room.
void read_fixtures(const JsonCursor& section, const StoreNames& names, const StoreFolder& folder,
                   Presets& presets, Store& store, Problems& problems);
/// Adds a label per row of a CSV with the columns `article`, `fixture`, `face`, `level`, and `x` or
/// `position`, in any order and among others. Requires the fixtures.
void read_planogram(const JsonCursor& section, const StoreNames& names, const StoreFolder& folder,
                    Store& store);
Label read_label(const JsonCursor& json, const StoreNames& names);
void read_labels(const JsonCursor& section, const StoreNames& names, const StoreFolder& folder, Store& store);
/// The areas, rails and faces of the section "transceivers". Requires the room and the fixtures.
void read_mounts(const JsonCursor& section, const StoreNames& names, Store& store);
/// Throws InputError for a name that the store's room does not have.
PlanArea read_plan_area(const JsonCursor& json, const Store& store);
KeepOut read_keep_out(const JsonCursor& json);
void read_transceivers(const JsonCursor& section, const StoreNames& names, const StoreFolder& folder,
                       Store& store);

/// The section "variation". Requires the room and the fixtures.
StoreVariation read_variation(const JsonCursor& json, const StoreNames& names, const Store& store);
/// Every value of the section; `read_variation` restores them to the bit.
nlohmann::ordered_json resolved(const StoreVariation& variation, const Store& store);

/// Reads labels from a CSV with the header `id,x,y,z,nx,ny,nz,type`. Throws InputError with file and line.
void read_labels_csv(const std::filesystem::path& path, const StoreNames& names, Store& store);

/// Reads transceivers from a CSV with the header `id,x,y,z,ax,ay,az,roll_deg,type`. Further columns are
/// ignored, so that placement.csv can be read back.
void read_transceivers_csv(const std::filesystem::path& path, const StoreNames& names, Store& store);

}  // namespace shelfbeam
