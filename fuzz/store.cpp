#include "shelfbeam/scene/store/store.hpp"

#include <stdexcept>

#include "shelfbeam/base/error.hpp"

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
    "s": { "emission": { "type": "sin2theta", "peak": 2 }, "radius": 0.01, "cost": 4, "order_number": "4711-B", "fixing": "magnet on the T-bar", "picture": "unit.svg" },
    "t": { "emission": { "type": "lambertian", "order": 20, "flux": 3 }, "picture": "data:image/jpeg;base64,/9j/AA==" },
    "u": { "emission": { "type": "table", "theta_deg": [0, 45, 120], "phi_deg": [0, 90, 200], "intensity": [[1, 2, 3], [4, 5, 6], [7, 8, 9]] } },
    "v": { "emission": { "type": "ies", "file": "profile.ies", "flux": 1 } },
    "w": { "emission": { "type": "eulumdat", "file": "profile.ldt", "flux": 1 } } },
  "fixtures": [
    { "type": "gondola", "id": "A", "at": [2, 1], "length": 3, "depth": 0.9, "height": 1.8, "rotation_deg": 30, "material": "white", "goods": "tile", "doors": "door", "shelves": [0.4, 0.9], "faces": ["front"], "stocking": 0.5, "labels": { "type": "a", "spacing": 0.8, "tilt_deg": 5 } },
    { "type": "freezer", "id": "F", "at": [5.5, 2], "length": 2, "depth": 0.8, "height": 0.9, "material": "white", "labels": { "type": "b", "spacing": 0.5, "faces": ["back", "left"] } },
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

// Any outline, copies, presets, and candidates on surfaces.
constexpr const char* shapes = R"({
  "catalogues": ["chain.json"], "currency": "EUR", "language": "de",
  "materials": { "white": { "type": "lambertian", "reflectance": 0.8 }, "door": { "type": "thin_dielectric", "ior": 1.5 } },
  "label_types": { "l": { "threshold": 0.02 }, "m": { "threshold": 0.04 } },
  "transceiver_types": { "t": { "emission": { "type": "isotropic", "intensity": 0.5 } } },
  "room": {
    "outline": [[0, 0], [12, 0], [12, 5], [20, 6], [20, 14], [0, 14]], "holes": [[[8, 8], [9, 8], [9, 9], [8, 9]]],
    "height": 3.2, "floor": "white", "ceiling": "white", "walls": "white", "wall_materials": { "2": "door" },
    "zones": [
      { "id": "low", "polygon": [[0, 9], [6, 9], [6, 14], [0, 14]], "height": 2.6, "ceiling": "red", "fascia": "white" },
      { "id": "sloped", "polygon": [[12, 5], [20, 6], [20, 10], [12, 10]], "height": [[12, 5, 2.8], [20, 6, 2.8], [12, 10, 3.9]] } ],
    "inner_walls": [
      { "id": "W1", "from": [4, 0], "to": [4, 6], "thickness": 0.12, "height": "ceiling", "material": "red",
        "openings": [ { "at": 1, "width": 0.9, "top": 2.1 }, { "at": 3, "width": 1, "bottom": 1, "top": 2, "pane": "door" } ] },
      { "id": "W2", "from": [4, 6], "to": [1, 6], "thickness": 0.2, "height": 2.2 },
      { "id": "W3", "from": [13, 12], "to": [20, 5.9], "thickness": 0.1, "height": 3 } ],
    "openings": [ { "wall": 0, "at": 1, "width": 1, "bottom": 0.8, "top": 2.4, "material": "door", "repeat": { "count": 3, "pier": 0.4 } },
                  { "wall": 2, "at": 4, "width": 1.1, "top": 2.1 } ] },
  "presets": {
    "base": { "type": "gondola", "depth": 0.5, "height": 1.8, "material": "white", "shelves": [0.3, 0.8], "faces": ["front"],
              "labels": { "type": "l", "count": 2, "level_types": { "2": "m" } } },
    "run": { "preset": "base", "length": 1.33, "labels": { "hook": 0.1 } } },
  "fixtures": [
    { "preset": "run", "id": "A{n}", "at": [5, 2], "rotation_deg": 15,
      "repeat": { "count": 2, "step": 1.33, "first": 3, "count2": 2, "step2": [0, 2.5], "mirror": true } },
    { "preset": "chest", "id": "F", "against": { "wall": 0, "from": 9, "gap": 0.1 } },
    { "preset": "run", "id": "E", "against": { "fixture": "F", "side": "right", "shift": 0.2 }, "labels": { "count": 1 } },
    { "type": "box", "id": "B", "size": [0.6, 0.4, 1], "material": "red", "against": { "fixture": "A3", "side": "back" } },
    { "type": "box", "id": "T", "at": [15, 12, 0], "size": [1.2, 0.8, 0.75], "rotation_deg": 30, "material": "white" },
    { "type": "prism", "id": "P", "polygon": [[7, 10], [9, 10], [9, 12], [8, 10.4], [7, 11]], "bottom": 0.1, "top": 1.1, "material": "white" },
    { "type": "cylinder", "id": "C", "at": [10, 7], "radius": 0.25, "top": "ceiling", "material": "red" },
    { "type": "panel", "id": "S", "corners": [[1, 1, 2.2], [3, 1, 2.2], [3, 1.3, 2.8]], "material": "white" } ],
  "labels": [ { "id": "L", "description": "Offers", "position": [1, 1, 1], "normal": [1, 0, 0], "type": "l" } ],
  "planogram": { "file": "planogram.csv", "type": "m", "hook": 0.02, "tilt_deg": 9,
    "fixtures": [ { "fixtures": "A*", "type": "l", "hook": 0.1 }, { "fixtures": "F", "tilt_deg": 30 } ] },
  "drawing": { "file": "plan.png", "size": [2480, 1754], "at": [-1, -1], "rotation_deg": -1.2, "crop": [0, 0, 2000, 1500],
    "scale": { "from": [212, 1530.5], "to": [2260, 1530.5], "length": 25 } },
  "measuring_planes": [ { "id": "MP", "type": "l", "origin": [6, 1, 0.5], "axes": [[1, 0, 0], [0, 0.8, 0.6]], "size": [2, 1.5], "spacing": 0.5 },
                        { "id": "MQ", "type": "l", "origin": [6, 4, 1], "axes": [[0, 1, 0], [1, 0, 0]], "size": [1, 1], "counts": [2, 3], "normal": [0, 0, 1] } ],
  "transceivers": {
    "areas": [ { "type": "t", "area": "room", "spacing": 3, "below_ceiling": 0.05, "axes": [[0, 0, -1], [0.5, 0, -0.866]], "roll_deg": 3 },
               { "type": "t", "area": "low", "spacing": 2, "z": 2.5 }, { "type": "t", "area": "room without zones", "spacing": 4, "z": 2.4 }, { "type": "t", "area": [[13, 11], [15, 11], [15, 13]], "spacing": 1, "z": 3 } ],
    "rails": [ { "id": "R", "type": "t", "points": [[1, 1, 2.8], [3, 1, 2.8], [3, 5, 2.5]], "spacing": 0.8, "axes": [[0, 1, -1]] } ],
    "on": [ { "type": "t", "fixture": "C", "z": 2.4, "spacing": 0.8, "tilt_deg": 30, "offset": 0.05, "roll_deg": 9 },
            { "type": "t", "wall": 2, "z": 2, "spacing": 2 }, { "type": "t", "inner_wall": "W1", "z": 2.3, "spacing": 2, "offset": 0.01 },
            { "type": "t", "fixture": "C", "face": "south", "z": 2, "spacing": 0.2 }, { "type": "t", "inner_wall": "W1", "face": "west", "z": 1.5, "spacing": 1 } ],
    "keep_out": [ { "polygon": [[3, 3], [5, 3], [4, 5]], "z": [2.0, 3.2] } ] }
})";

// A box room with zones and inner walls, and labels in all forms.
constexpr const char* divided_box = R"({
  "units": "cm",
  "materials": { "m": { "type": "lambertian", "reflectance": 0.5 } },
  "label_types": { "l": { "threshold": 0.02 } },
  "transceiver_types": { "t": { "emission": { "type": "isotropic", "intensity": 0.5 } } },
  "room": { "size": [800, 600, 300], "floor": "m", "ceiling": "m", "walls": { "x0": "m", "x1": "m", "y0": "m", "y1": "m" },
            "zones": [ { "id": "low", "polygon": [[0, 500], [200, 500], [200, 600], [0, 600]], "height": 250 } ],
            "inner_walls": [ { "id": "W", "from": [500, 0], "to": [600, 100], "height": 200 } ],
            "openings": [ { "wall": "x1", "at": 100, "width": 120, "bottom": 90, "top": 220, "material": "m" } ] },
  "fixtures": [
    { "type": "freezer", "id": "F{n}", "at": [200, 200], "length": 200, "depth": 80, "height": 90, "material": "m",
      "labels": { "type": "l", "count": 2, "faces": ["front", "left"], "on_top": true, "tilt_deg": 60 },
      "repeat": { "count": 2, "step": [0, 150] } },
    { "type": "gondola", "id": "A", "at": [450, 200], "length": 200, "depth": 90, "height": 180, "material": "m", "shelves": [40, 90],
      "labels": { "type": "l", "positions": [10, 55.5, 190], "hook": 25 } } ],
  "planogram": { "file": "segments.csv", "type": "l", "segments": [
    { "planogram": "P", "segments": [1], "fixture": "A", "face": "back", "from": 20, "to": 190, "first_shelf": 2 },
    { "planogram": "Q", "fixture": "F2", "face": "left", "right_to_left": true, "from_top": true } ] },
  "transceivers": { "areas": [ { "type": "t", "area": "room", "spacing": 100, "z": 290, }, ], }, // "currency": "EUR"
})";

const std::filesystem::path& folder() {
  static const std::filesystem::path made = [] {
    scratch().write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    scratch().write("unit.svg", "<svg xmlns='http://www.w3.org/2000/svg'/>");
    scratch().write("profile.ies", source_file("data/photometry/wide-ceiling.ies"));
    scratch().write("profile.ldt", source_file("data/photometry/wide-ceiling.ldt"));
    scratch().write("labels.csv", "id,x,y,z,nx,ny,nz,type\nP,5,0.01,1.5,0,1,0,c\n");
    scratch().write("chain.json",
                    R"({ "units": "m", "materials": { "red": { "type": "lambertian", "reflectance": 0.3 } },
      "presets": { "chest": { "type": "freezer", "length": 2, "depth": 0.8, "height": 0.9, "material": "red" } } })");
    scratch().write(
        "planogram.csv",
        "article,fixture,face,level,position,name\n1,A3,front,2,1,Jam\n2,A3,front,2,3\n1,F,left,1,1,\n");
    scratch().write("segments.csv",
                    "upc,planogram,segment,shelf,sequence,facings\n1,P,1,2,1,2\n2,P,1,3,1,1\n1,Q,4,1,1,\n");
    scratch().write("units.csv", "id,x,y,z,ax,ay,az,roll_deg,type\ntill,6,5,2.9,0,0,-1,0,v\n");
    return scratch().path();
  }();
  return made;
}

void fuzz_store(std::string_view bytes) {
  constexpr std::size_t memory = 1 << 26;
  const Store store = parse_store(std::string(bytes), "store.json", folder(), {false, memory});
  const Scene scene = make_scene(store);
  const std::string resolved = resolved_store_json(store, scene);
  constexpr std::size_t quickly_read = 1000;
  if (scene.labels.size() + scene.transceivers.size() > quickly_read) return;
  try {
    make_scene(parse_store(resolved, "resolved.json", folder(), {false, memory}));
  } catch (const InputError& error) {
    throw std::logic_error(std::string("the resolved store is refused: ") + error.what());
  }
}

std::vector<std::string> store_seeds() {
  return {every_section, lists, shapes, divided_box, source_file("examples/thesis/store.json")};
}

}  // namespace

extern const Reader store;
const Reader store{"store", fuzz_store, store_seeds};

}  // namespace shelfbeam::fuzz
