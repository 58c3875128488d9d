#pragma once

#include <filesystem>

#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/scene/store_names.hpp"

namespace shelfbeam {

/// Labels from a CSV with the header `id,x,y,z,nx,ny,nz,type`. Throws InputError with file and line.
void read_labels_csv(const std::filesystem::path& path, const StoreNames& names, Store& store);

/// Transceivers from a CSV with the header `id,x,y,z,ax,ay,az,roll_deg,type`; further columns are ignored, so
/// that placement.csv can be read back.
void read_transceivers_csv(const std::filesystem::path& path, const StoreNames& names, Store& store);

}  // namespace shelfbeam
