#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/scene/store/store_names.hpp"
#include "shelfbeam/scene/store_folder.hpp"

namespace shelfbeam {

// The sections of a store file; each reads one and throws InputError with its JSON path.

void read_materials(const JsonCursor& section, Store& store);
void read_transceiver_types(const JsonCursor& section, const StoreFolder& folder, Store& store);
/// After the transceiver types, which a threshold may name.
void read_label_types(const JsonCursor& section, Store& store);
void read_fixtures(const JsonCursor& section, const StoreNames& names, const StoreFolder& folder,
                   Store& store);
void read_labels(const JsonCursor& section, const StoreNames& names, const StoreFolder& folder, Store& store);
void read_transceivers(const JsonCursor& section, const StoreNames& names, const StoreFolder& folder,
                       Store& store);

/// Pieces of the mesh file of that name in the folder (glTF, GLB, OBJ, STL, PLY), nodes placed, materials
/// mapped: the first pattern of `materials` (pattern -> material) that matches the name in the file counts;
/// surfaces that name no material, as all of STL and PLY, have the empty name. Throws InputError, among
/// others for what is not finite. Where `y_is_up` is not given, y is up in glTF, which defines it so, and z
/// in the other formats, which say nothing.
std::vector<MeshPiece> import_mesh(const std::filesystem::path& name, const StoreFolder& folder,
                                   std::optional<bool> y_is_up,
                                   const std::vector<std::pair<std::string, MaterialId>>& materials,
                                   const std::string& where);

}  // namespace shelfbeam
