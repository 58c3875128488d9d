#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/scene/warning_list.hpp"

namespace shelfbeam {

/// The side of the room beyond which the point lies, for example "above the ceiling (4.2 m > 4 m)"; empty if
/// the point is inside the room or there is no room.
std::string beyond_room(const Scene& scene, const Vec3& p);

/// Whether a fixture extends outside the room: the last that was added to the scene, with these first vertex
/// and first part. Also true for a fixture across a hole, or with its top above a lower zone. Only the
/// vertices of meshes count.
bool extends_outside_room(const Scene& scene, std::size_t first_vertex, std::size_t first_part);

/// A remedy for a list with positions outside the room: exchanged coordinates or another unit of length, if
/// most of several positions are outside and nearly all would then be inside; otherwise a general remedy.
std::string remedy_outside(const RoomShape& room, const std::vector<Vec3>& listed);

/// Adds warnings about implausible positions: labels and transceivers inside or partly inside a fixture or
/// partly outside the room, labels that face a fixture or wall closer than 5 cm and, without a room,
/// transceivers outside the bounds of all surfaces. Panes are not checked. Neither are meshes, because only
/// their hull is known here, which may contain devices that are outside the mesh itself. Throws Interrupted.
void warn_of_misplaced(const Scene& scene, const DeviceSources& sources, WarningList& warnings,
                       const CancelToken* cancel);

}  // namespace shelfbeam
