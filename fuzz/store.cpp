#include "shelfbeam/scene/store/store.hpp"

#include "reader.hpp"
#include "scratch_folder.hpp"

namespace shelfbeam::fuzz {

namespace {

constexpr const char* every_section = R"({
  "room": { "size": [8, 6, 3], "floor": "tile", "ceiling": "white", "walls": { "x0": "foil", "x1": "white", "y0": "jar", "y1": "door" } },
  "materials": {
    "white": { "type": "lambertian", "reflectance": 0.8 },
    "tile": { "type": "plastic", "ior": 1.5, "reflectance": 0.6, "roughness": 0.3 },
    "foil": { "type": "conductor", "eta": 1.7, "k": 8.6, "roughness": [0.2, 0.4], "distribution": "beckmann" },
    "jar": { "type": "dielectric", "ior": 1.5, "roughness": 0.1 },
    "door": { "type": "thin_dielectric", "ior": 1.5, "thickness": 0.006, "absorption_per_m": 54 } },
  "label_types": {
    "a": { "threshold": 0.02, "safety_factor": 1.25, "size": [0.2, 0.1], "link_cost": 1, "signal_cost": 2 },
    "b": { "responsivity": { "type": "cosine_power", "exponent": 2, "cutoff_deg": 60 }, "threshold": { "hears": "t", "at_m": 5, "angle_deg": 45 } },
    "c": { "responsivity": { "type": "table", "theta_deg": [0, 40, 75], "response": [2, 1, 0] }, "threshold": 0.1 } },
  "transceiver_types": {
    "s": { "emission": { "type": "sin2theta", "peak": 2 }, "radius": 0.01, "cost": 4 },
    "t": { "emission": { "type": "lambertian", "order": 20, "flux": 3 } },
    "u": { "emission": { "type": "table", "theta_deg": [0, 45, 120], "phi_deg": [0, 90, 200], "intensity": [[1, 2, 3], [4, 5, 6], [7, 8, 9]] } },
    "v": { "emission": { "type": "ies", "file": "profile.ies", "flux": 1 } },
    "w": { "emission": { "type": "eulumdat", "file": "profile.ldt", "flux": 1 } } },
  "fixtures": [
    { "type": "gondola", "id": "A", "at": [2, 1], "length": 3, "depth": 0.9, "height": 1.8, "rotation_deg": 30, "material": "white", "goods": "tile", "doors": "door", "shelves": [0.4, 0.9], "faces": ["front"], "stocking": 0.5, "labels": { "type": "a", "spacing": 0.8, "tilt_deg": 5 } },
    { "type": "freezer", "id": "F", "at": [7, 2], "length": 2, "depth": 0.8, "height": 0.9, "material": "white", "labels": { "type": "b", "spacing": 0.5, "faces": ["back", "left"] } },
    { "type": "box", "id": "B", "min": [0, 4, 0], "max": [0.4, 4.4, 3], "material": "foil" },
    { "type": "mesh", "id": "M", "file": "mesh.obj", "at": [4, 5, 0], "scale": 0.5, "up": "z", "materials": { "x*": "jar", "*": "white" } },
    { "type": "mesh", "id": "N", "at": [5, 5, 0], "parts": [ { "name": "p", "material": "jar", "vertices": [[0,0,0],[1,0,0],[0,1,0]], "faces": [[0,1,2]] } ] } ],
  "labels": { "csv": "labels.csv" },
  "transceivers": {
    "grids": [ { "type": "s", "min": [1, 1], "max": [7, 5], "spacing": 2, "z": 2.9, "axis": [0, 1, -1], "roll_deg": 3 } ],
    "list": { "csv": "units.csv" }, "keep_out": [ { "min": [3, 3], "max": [4, 5] } ], "installed": [ "till" ] }
})";

constexpr const char* lists = R"({ // comments, too
  "units": "ft",
  "materials": { "m": { "type": "lambertian", "reflectance": 0.5 } },
  "label_types": { "l": { "threshold": 0.02 } },
  "transceiver_types": { "t": { "emission": { "type": "isotropic", "intensity": 0.5 } } },
  "fixtures": [ { "type": "box", "id": "B", "min": [0, 0, 0], "max": [1, 1, 1], "material": "m" } ],
  "labels": [ { "id": "L", "position": [1, 1, 1.5], "normal": [0, 1, 0], "type": "l" } ],
  "transceivers": { "list": [ { "id": "T", "position": [1, 2, 3], "axis": [0, 0, -1], "roll_deg": 90, "type": "t" } ] }
})";

const std::filesystem::path& folder() {
  static const std::filesystem::path made = [] {
    scratch().write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    scratch().write("profile.ies", source_file("data/photometry/wide-ceiling.ies"));
    scratch().write("profile.ldt", source_file("data/photometry/wide-ceiling.ldt"));
    scratch().write("labels.csv", "id,x,y,z,nx,ny,nz,type\nP,5,0.01,1.5,0,1,0,c\n");
    scratch().write("units.csv", "id,x,y,z,ax,ay,az,roll_deg,type\ntill,6,5,2.9,0,0,-1,0,v\n");
    return scratch().path();
  }();
  return made;
}

void read(std::string_view bytes) {
  constexpr std::size_t memory = 1 << 26;
  const Store store = parse_store(std::string(bytes), "store.json", folder(), {false, memory});
  const Scene scene = make_scene(store);
  resolved_store_json(store, scene);
}

std::vector<std::string> seeds() {
  return {every_section, lists, source_file("examples/thesis/store.json")};
}

}  // namespace

extern const Reader store;
const Reader store{"store", read, seeds};

}  // namespace shelfbeam::fuzz
