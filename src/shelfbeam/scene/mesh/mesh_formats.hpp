#pragma once

#include <filesystem>

#include "shelfbeam/scene/mesh/mesh_lines.hpp"
#include "shelfbeam/scene/mesh/mesh_triangles.hpp"
#include "shelfbeam/scene/store_folder.hpp"

namespace shelfbeam {

// The readers of mesh files, one a format. A count of a file is believed only as far as its bytes go. All
// throw InputError: for a file that ends early, an index beyond its vertices, a coordinate that is no finite
// number, and more triangles than the memory holds.

/// Vertices, faces and the names of their materials; all else is passed over.
void read_obj(MeshLines& lines, MeshTriangles& triangles);
/// ASCII or binary: a file that is as long as a binary one says is one, however it begins.
void read_stl(MeshLines& lines, MeshTriangles& triangles);
/// ASCII or binary: the elements `vertex` and `face`.
void read_ply(MeshLines& lines, MeshTriangles& triangles);
/// glTF 2.0, JSON or GLB: the nodes of the default scene, in place. Buffers lie in the file or beside it;
/// `name` is the file's in `folder`.
void read_gltf(MeshLines& lines, const std::filesystem::path& name, const StoreFolder& folder,
               MeshTriangles& triangles);

}  // namespace shelfbeam
