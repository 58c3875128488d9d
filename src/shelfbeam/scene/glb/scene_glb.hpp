#pragma once

#include <string>

#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// The scene as a binary glTF 2.0 file (GLB) for any viewer of 3-D models, in m. Its nodes:
///
///   - `room`: floor and walls, which are the triangles of no fixture;
///   - `ceiling`: those of them that are above the floor and not upright, so that a viewer can hide them;
///   - one node per fixture, with its id as name;
///   - `labels`: a rectangle per label, facing its normal: its size, or 5 x 3 cm for a point;
///   - `candidates` and `installed`: an octahedron per transceiver, whose long tip is its axis.
///
/// Nodes without content are omitted, except those of fixtures. The materials are those of the store, grey by
/// their reflectances, and then those of labels and transceivers. Equal scenes have equal bytes. The scene
/// must have triangles. Throws InputError if the file exceeds 4 GiB.
std::string scene_glb(const Scene& scene);

}  // namespace shelfbeam
