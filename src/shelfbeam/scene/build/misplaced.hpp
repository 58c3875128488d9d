#pragma once

#include <string>
#include <vector>

#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/warning_list.hpp"

namespace shelfbeam {

/// The places in the store file, for messages, of a scene's labels and transceivers, in their order; a
/// generated one has that of its fixture or grid.
struct DevicePlaces {
  std::vector<std::string> labels, transceivers;
};

/// Which side of the room the point lies beyond, as "above the ceiling (4.2 m > 4 m)"; empty when it lies
/// within, or there is no room.
std::string beyond_room(const Scene& scene, const Vec3& p);

/// Adds warnings of labels and transceivers in places that can hardly be meant: inside a fixture, with a
/// corner or edge in one or outside the room; labels that look at a fixture or wall from less than 5 cm;
/// without a room, transceivers outside of all surfaces. Meshes are left out: they are only known by their
/// hull here, which may hold devices that stand free. So are panes.
void warn_of_misplaced(const Scene& scene, const DevicePlaces& places, WarningList& warnings);

}  // namespace shelfbeam
