#pragma once

#include <vector>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/scene/mesh/gltf_file.hpp"
#include "shelfbeam/scene/mesh/gltf_placement.hpp"

namespace shelfbeam {

// Both functions throw InputError.

/// The weights of the morph targets of a node's mesh: those of the node, or else of the mesh.
std::vector<double> morph_weights(const JsonCursor& node, const JsonCursor& mesh);

/// The vertices of a primitive, morphed with `weights`, then moved by the `joints` of its skin. Without
/// joints it has no skin.
std::vector<Vec3> gltf_vertices(GltfFile& file, const JsonCursor& primitive,
                                const std::vector<double>& weights, const std::vector<GltfPlacement>& joints);

}  // namespace shelfbeam
