#pragma once

#include <nlohmann/json.hpp>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/material/material.hpp"
#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam {

/// The section "materials" of a store file. Throws InputError with its JSON path.
void read_materials(const JsonCursor& section, Store& store);

/// A material as the resolved store writes it; read back it is the same to the bit.
nlohmann::ordered_json resolved(const Material& material);

}  // namespace shelfbeam
