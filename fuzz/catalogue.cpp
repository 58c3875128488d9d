#include "shelfbeam/scene/store/store.hpp"

#include "reader.hpp"
#include "scratch_folder.hpp"

namespace shelfbeam::fuzz {

namespace {

constexpr const char* catalogue_store = R"({
  "catalogues": ["catalogue.json"],
  "materials": { "m": { "type": "lambertian", "reflectance": 0.5 } },
  "presets": { "own": { "type": "gondola", "depth": 0.9, "height": 1.8, "material": "m", "shelves": [0.4] } },
  "room": { "size": [8, 6, 3], "floor": "m", "ceiling": "m", "walls": "m" },
  "fixtures": [ { "preset": "run", "id": "A", "at": [2, 3] } ],
  "labels": [ { "id": "L", "position": [1, 1, 1], "normal": [1, 0, 0], "type": "l" } ],
  "transceivers": { "list": [ { "id": "T", "position": [1, 2, 3], "type": "t" } ] }
})";

void fuzz_catalogue(std::string_view bytes) {
  constexpr std::size_t memory = 1 << 26;
  scratch().write("catalogue.json", bytes);
  make_scene(parse_store(catalogue_store, "store.json", scratch().path(), {false, memory}));
}

std::vector<std::string> catalogue_seeds() {
  return {R"({ "$schema": "x", "units": "m",
    "presets": { "run": { "preset": "base", "length": 1.33, "labels": { "spacing": 0.33 } },
                 "base": { "preset": "own", "goods": "carton", "labels": { "type": "l", "spacing": 0.5 } } },
    "materials": { "carton": { "type": "plastic", "ior": 1.5, "reflectance": 0.6 } },
    "label_types": { "l": { "threshold": { "hears": "t", "at_m": 5 } } },
    "transceiver_types": { "t": { "emission": { "type": "isotropic", "intensity": 0.5 } } } })",
          R"({ "presets": { "run": { "type": "cylinder", "radius": 0.2, "top": "ceiling",
                                    "repeat": { "count": 1, "step": 1 }, "material": "m" } },
    "label_types": { "l": { "threshold": 1 } },
    "transceiver_types": { "t": { "emission": { "type": "lambertian", "flux": 3 } } } })"};
}

}  // namespace

extern const Reader catalogue;
const Reader catalogue{"catalogue", fuzz_catalogue, catalogue_seeds};

}  // namespace shelfbeam::fuzz
