#pragma once

#include <string>

#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/scene/warning_list.hpp"

namespace shelfbeam {

/// The mesh as the scene takes it: without triangles that have no area, solid dielectrics with their outside
/// out. Says what it changed, and what looks wrong, in `warnings`. Throws InputError when no triangle is left
/// or the size cannot be meant.
MeshFixture sound_mesh(MeshFixture mesh, const Store& store, const std::string& where, WarningList& warnings);

}  // namespace shelfbeam
