#pragma once

#include "unit/scene/sample_store.hpp"

namespace shelfbeam::test {

/// Mistakes in the sample store, one for each kind of value, at places that do not depend on each other: the
/// position of a value, the value, and the path of the problem that it causes.
inline const Json& mistakes() {
  static const Json all = R"([
    ["/name", 7, "name"],
    ["/wavelength_nm", "infrared", "wavelength_nm"],
    ["/currency", "", "currency"],
    ["/language", "fr", "language"],
    ["/planet", "Mars", ""],
    ["/room/floor", "lava", "room.floor"],
    ["/room/size/1", -6, "room.size[1]"],
    ["/room/ceiling", 7, "room.ceiling"],
    ["/room/walls/x1", "lava", "room.walls.x1"],
    ["/room/walls/z0", "white", "room.walls"],
    ["/room/wall_materials", {"7": "white"}, "room.wall_materials"],
    ["/room/zones", [{"id": "low", "polygon": [[0, 5], [2, 5]], "height": 2}], "room.zones[0].polygon"],
    ["/room/inner_walls", [{"id": "W", "from": [5, 0], "to": [6, 1], "openings": [{"at": 0.1, "width": 1, "top": -1}]}],
      "room.inner_walls[0].openings[0].top"],
    ["/materials/foil/eta", -1, "materials.foil.eta"],
    ["/materials/chrome/distribution", "phong", "materials.chrome.distribution"],
    ["/materials/chrome/sampling", 7, "materials.chrome.sampling"],
    ["/materials/chrome/colour", 1, "materials.chrome"],
    ["/materials/jar/ior", 9, "materials.jar.ior"],
    ["/materials/jar/roughness", 7, "materials.jar.roughness"],
    ["/materials/white/reflectance", 1.2, "materials.white.reflectance"],
    ["/materials/foil/k", "k", "materials.foil.k"],
    ["/label_types/small/threshold", -1, "label_types.small.threshold"],
    ["/label_types/small/colour", 1, "label_types.small"],
    ["/transceiver_types/down/cost", -4, "transceiver_types.down.cost"],
    ["/transceiver_types/spot/emission/flux", null, "transceiver_types.spot.emission.flux"],
    ["/fixtures/0/length", -3, "fixtures[0].length"],
    ["/fixtures/0/depth", 0.01, "fixtures[0].depth"],
    ["/fixtures/0/material", "sugar", "fixtures[0].material"],
    ["/fixtures/0/shelves/1", "high", "fixtures[0].shelves[1]"],
    ["/fixtures/0/colour", 1, "fixtures[0]"],
    ["/fixtures/0/labels/type", "none", "fixtures[0].labels.type"],
    ["/fixtures/0/labels/tilt_deg", 120, "fixtures[0].labels.tilt_deg"],
    ["/fixtures/1/height", 0.1, "fixtures[1].height"],
    ["/fixtures/1/stocking", 3, "fixtures[1].stocking"],
    ["/fixtures/1/rotation_deg", 720, "fixtures[1].rotation_deg"],
    ["/fixtures/2/max", [0, 0], "fixtures[2].max"],
    ["/labels/0/position", [1, 2], "labels[0].position"],
    ["/labels/0/normal", [0, 0, 0], "labels[0].normal"],
    ["/labels/0/type", "none", "labels[0].type"],
    ["/transceivers/grids/0/spacing", 0, "transceivers.grids[0].spacing"],
    ["/transceivers/grids/0/z", [3], "transceivers.grids[0].z"],
    ["/transceivers/list/0/type", "none", "transceivers.list[0].type"],
    ["/transceivers/list/0/roll_deg", 1000, "transceivers.list[0].roll_deg"],
    ["/transceivers/keep_out/0/colour", 1, "transceivers.keep_out[0]"]
  ])"_json;
  return all;
}

}  // namespace shelfbeam::test
