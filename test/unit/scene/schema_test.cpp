#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"

#include "support/process.hpp"
#include "support/temp_folder.hpp"
#include "unit/scene/sample_store.hpp"

// The published schema and the reader must agree: on every store below, each of which has one value of the
// sample replaced, on the examples, and on what resolves from them.

namespace shelfbeam {
namespace {

using test::changed_store;
using test::sample_store;
using test::TempFolder;

const std::string photometry = SHELFBEAM_SOURCE_DIR "/data/photometry/";

struct Change {
  std::string pointer, value;  // as changed_store takes them
};

// Values at the very limits, keys left out, and the other forms of what has two.
const std::vector<Change> good = {
    {"/name", "\"\""},
    {"/name", ""},
    {"/$schema", ""},
    {"/wavelength_nm", "100"},
    {"/wavelength_nm", ""},
    {"/room/walls", "\"steel\""},
    {"/room", ""},
    {"/room/size/2", "1000"},
    {"/materials/white/reflectance", "1"},
    {"/materials/white/reflectance", "0"},
    {"/materials/white/reflectance", "\"plaster\""},
    {"/materials/carton/reflectance", "\"printed_carton\""},
    {"/materials/white/reflectance_range", "[0, 1]"},
    {"/materials/carton/reflectance_range", "[0, 1]"},
    {"/materials/foil/eta", "0"},
    {"/materials/foil/k", "100"},
    {"/materials/foil/roughness", "0"},
    {"/materials/foil/roughness", "0.001"},
    {"/materials/foil/roughness", "[1, 0.001]"},
    {"/materials/chrome/masking", "\"cook_torrance\""},
    {"/materials/chrome/masking", ""},
    {"/materials/chrome/sampling", ""},
    {"/materials/jar/masking", "\"smith\""},
    {"/materials/jar/sampling", "\"all\""},
    {"/materials/jar/distribution", "\"beckmann\""},
    {"/materials/jar/roughness", "[0.1, 0.2]"},
    {"/materials/jar/ior", "1.01"},
    {"/materials/jar", R"({ "type": "dielectric", "ior": 1 })"},
    {"/materials/carton/roughness", "0.5"},
    {"/materials/carton/ior", "4"},
    {"/materials/door/absorption_per_m", ""},
    {"/materials/door", R"({ "type": "thin_dielectric", "ior": 1.5 })"},
    {"/label_types/small/responsivity", ""},
    {"/label_types/deep/responsivity/cutoff_deg", ""},
    {"/label_types/deep/responsivity/cutoff_deg", "90"},
    {"/label_types/deep/responsivity/exponent", "0"},
    {"/label_types/measured/responsivity/theta_deg", "[0, 40, 90]"},
    {"/label_types/small/size", "[0.001, 10]"},
    {"/label_types/small/threshold", R"({ "hears": "wide", "at_m": 1000 })"},
    {"/label_types/deep/threshold/angle_deg", "89.5"},
    {"/label_types/small/size", "[0.0, -0.0]"},
    {"/label_types/small/size", ""},
    {"/label_types/small/safety_factor", ""},
    {"/label_types/small/threshold", "1e-12"},
    {"/label_types/small/link_cost", "0"},
    {"/transceiver_types/down/radius", ""},
    {"/transceiver_types/down/cost", "0"},
    {"/transceiver_types/spot/emission/order", "0"},
    {"/transceiver_types/fan/emission/phi_deg", "[0, 180, 360]"},
    {"/transceiver_types/ring/emission/theta_deg", "[0, 90, 180]"},
    {"/transceiver_types/ring/emission/theta_deg", "[90, 135, 180]"},
    {"/transceiver_types/ring/emission",
     R"({ "type": "ies", "flux": 2, "file": ")" + photometry + "batwing.ies\" }"},
    {"/transceiver_types/ring/emission",
     R"({ "type": "eulumdat", "flux": 1e-12, "file": ")" + photometry + "batwing.ldt\" }"},
    {"/transceiver_types/disc/radius", "10"},
    {"/transceiver_types/disc/radius", "0.0001"},
    {"/transceiver_types/ring/emission/intensity", "[0, 0, 1e9]"},
    {"/fixtures", ""},
    {"/fixtures", "[]"},
    {"/fixtures/0/rotation_deg", "-360"},
    {"/fixtures/0/goods", ""},
    {"/fixtures/0/doors", "\"white\""},
    {"/fixtures/1/doors", "\"white\""},
    {"/fixtures/0/stocking", "0"},
    {"/fixtures/0/stocking", ""},
    {"/fixtures/0/faces", ""},
    {"/fixtures/0/faces", "[\"back\"]"},
    {"/fixtures/0/labels", ""},
    {"/fixtures/0/labels/faces", ""},
    {"/fixtures/0/labels/tilt_deg", "-89"},
    {"/fixtures/0/shelves", "[0.05, 0.1]"},
    {"/fixtures/0/depth", "0.1"},
    {"/fixtures/1/labels/faces", "[\"right\", \"back\"]"},
    {"/fixtures/1/depth", "0.3"},
    {"/fixtures/1/id", "\"Kühltruhe, links \\\"A\\\"\""},
    {"/fixtures/3/scale", ""},
    {"/fixtures/3/parts/0/name", "\"\""},
    {"/fixtures/3/parts/0/faces/0", "[1, 1, 1.0]"},
    {"/fixtures/3/parts/0/vertices/0", "[100, 100, 0]"},
    {"/labels", "[]"},
    {"/labels", ""},
    {"/transceivers/grids/0/axis", ""},
    {"/transceivers/grids", ""},
    {"/transceivers/list/1", ""},
    {"/transceivers/list/0/axis", "[1e-200, 0, 0]"},
    {"/transceivers/keep_out", "[]"},
    {"/transceivers/keep_out/0/max", "[0, 0]"},
    {"/transceivers/installed", ""},
    {"/transceivers/installed", "[\"T1\", \"T1\"]"},
};

const std::vector<Change> bad = {
    {"/nam", "\"x\""},
    {"/name", "3"},
    {"/$schema", "3"},
    {"/wavelength_nm", "\"940\""},
    {"/wavelength_nm", "99"},
    {"/wavelength_nm", "1e6"},
    {"/wavelength_nm", "null"},
    {"/materials", ""},
    {"/label_types", ""},
    {"/transceiver_types", ""},
    {"/transceivers", ""},
    {"/materials", "[]"},
    {"/room", "[8, 6, 3]"},
    {"/room/size", "[8, 6]"},
    {"/room/size", "[8, 6, 3, 1]"},
    {"/room/size/1", "-6"},
    {"/room/size/1", "0"},
    {"/room/size/1", "1001"},
    {"/room/size/1", "\"6\""},
    {"/room/floor", ""},
    {"/room/floor", "7"},
    {"/room/ceilings", "\"white\""},
    {"/room/walls", "[\"white\"]"},
    {"/room/walls/x0", ""},
    {"/room/walls/z0", "\"white\""},
    {"/materials/", R"({ "type": "lambertian", "reflectance": 0.5 })"},
    {"/materials/a\nb", R"({ "type": "lambertian", "reflectance": 0.5 })"},
    {"/materials/white/type", "\"lambert\""},
    {"/materials/white/type", ""},
    {"/materials/white/reflectance", "1.01"},
    {"/materials/white/reflectance", "-0.01"},
    {"/materials/white/reflectance", "true"},
    {"/materials/white/reflectance", ""},
    {"/materials/white/reflectance_range", "0.1"},
    {"/materials/white/reflectance_range", "[0]"},
    {"/materials/white/reflectance_range", "[0, 1, 1]"},
    {"/materials/white/reflectance_range", "[0, 1.1]"},
    {"/materials/carton/reflectance_range", "[-0.1, 1]"},
    {"/materials/foil/reflectance_range", "[0, 1]"},
    {"/materials/door/reflectance_range", "[0, 1]"},
    {"/materials/white/roughness", "0.1"},
    {"/materials/white/reflectance", "\"plastre\""},
    {"/materials/white/eta", "1"},
    {"/materials/foil/eta", ""},
    {"/materials/foil/k", ""},
    {"/materials/foil/k", "-1"},
    {"/materials/foil/eta", "101"},
    {"/materials/foil/ior", "1.5"},
    {"/materials/foil/reflectance", "0.9"},
    {"/materials/foil/distribution", "\"ggx\""},
    {"/materials/foil/masking", "\"smith\""},
    {"/materials/foil/sampling", "\"all\""},
    {"/materials/foil/roughness", "0.0009"},
    {"/materials/foil/roughness", "1.1"},
    {"/materials/foil/roughness", "-0.1"},
    {"/materials/foil/roughness", "\"high\""},
    {"/materials/foil/roughness", "[0.3]"},
    {"/materials/foil/roughness", "[0.3, 0.3, 0.3]"},
    {"/materials/foil/roughness", "[0, 0.3]"},
    {"/materials/chrome/distribution", "\"phong\""},
    {"/materials/chrome/distribution", "\"ggx\""},
    {"/materials/chrome/distribution", ""},
    {"/materials/chrome/sampling", "\"visible\""},
    {"/materials/chrome/masking", "\"smyth\""},
    {"/materials/chrome/roughness", ""},
    {"/materials/chrome/roughness", "0"},
    {"/materials/carton/ior", ""},
    {"/materials/carton/ior", "0.9"},
    {"/materials/carton/ior", "4.1"},
    {"/materials/carton/reflectance", ""},
    {"/materials/carton/reflectance", "1.1"},
    {"/materials/carton/reflectance", "\"carton\""},
    {"/materials/carton/roughness", "[0.2, 0.2]"},
    {"/materials/carton/masking", "\"smith\""},
    {"/materials/jar/ior", "1.009"},
    {"/materials/jar/ior", ""},
    {"/materials/jar/masking", "\"cook_torrance\""},
    {"/materials/jar/masking", "\"smith_rational\""},
    {"/materials/jar/reflectance", "0.5"},
    {"/materials/door/ior", ""},
    {"/materials/door/thickness", ""},
    {"/materials/door/thickness", "1.1"},
    {"/materials/door/thickness", "-0.01"},
    {"/materials/door/absorption_per_m", "1e7"},
    {"/materials/door/roughness", "0"},
    {"/label_types/small/threshold", ""},
    {"/label_types/small/threshold", "0"},
    {"/label_types/small/threshold", "-0.02"},
    {"/label_types/small/threshold", "1e-13"},
    {"/label_types/small/threshold", "1e10"},
    {"/label_types/small/safety_factor", "0"},
    {"/label_types/small/threshold", "\"down\""},
    {"/label_types/deep/threshold/hears", ""},
    {"/label_types/deep/threshold/at_m", ""},
    {"/label_types/deep/threshold/at_m", "0"},
    {"/label_types/deep/threshold/at_m", "1001"},
    {"/label_types/deep/threshold/angle_deg", "181"},
    {"/label_types/deep/threshold/angle_deg", "-45"},
    {"/label_types/deep/threshold/angle", "45"},
    {"/label_types/small/size", "[0.1, 0]"},
    {"/label_types/small/size", "[0.1, 0.0009]"},
    {"/label_types/small/size", "[10.1, 0.1]"},
    {"/label_types/small/size", "[-0.1, -0.1]"},
    {"/label_types/small/size", "[0]"},
    {"/label_types/small/size", "0"},
    {"/label_types/small/responsivity/type", "\"cosinus\""},
    {"/label_types/small/responsivity/power", "2"},
    {"/label_types/deep/responsivity/type", "\"cosine\""},
    {"/label_types/deep/responsivity/type", ""},
    {"/label_types/deep/responsivity/exponent", ""},
    {"/label_types/deep/responsivity/exponent", "-1"},
    {"/label_types/deep/responsivity/exponent", "1001"},
    {"/label_types/deep/responsivity/cutoff_deg", "90.1"},
    {"/label_types/deep/responsivity/cutoff_deg", "0"},
    {"/label_types/measured/responsivity/theta_deg", "[0, 40, 91]"},
    {"/label_types/measured/responsivity/theta_deg", "[0]"},
    {"/label_types/measured/responsivity/theta_deg", ""},
    {"/label_types/measured/responsivity/response", "[1, -1, 0]"},
    {"/label_types/measured/responsivity/response", ""},
    {"/label_types/measured/responsivity/phi_deg", "[0]"},
    {"/label_types/small/link_cost", "-1"},
    {"/label_types/small/signal_cost", "\"3\""},
    {"/label_types/small/gamma", "1"},
    {"/transceiver_types/down/emission", ""},
    {"/transceiver_types/down/emission", "\"sin2theta\""},
    {"/transceiver_types/down/emission/type", "\"ies\""},
    {"/transceiver_types/down/emission/peak", "0"},
    {"/transceiver_types/down/emission/peak", ""},
    {"/transceiver_types/down/emission/intensity", "1"},
    {"/transceiver_types/wide/emission/intensity", "-1"},
    {"/transceiver_types/wide/emission/intensity", "[1]"},
    {"/transceiver_types/spot/emission/flux", ""},
    {"/transceiver_types/spot/emission/order", "-1"},
    {"/transceiver_types/spot/emission/peak", "1"},
    {"/transceiver_types/ring/emission/theta_deg", "[0]"},
    {"/transceiver_types/ring/emission/theta_deg/2", "181"},
    {"/transceiver_types/ring/emission/intensity/1", "-1"},
    {"/transceiver_types/ring/emission/intensity/1", "[1, 2, 3]"},
    {"/transceiver_types/fan/emission/phi_deg", "[]"},
    {"/transceiver_types/fan/emission/phi_deg/2", "361"},
    {"/transceiver_types/fan/emission/intensity/0", "5"},
    {"/transceiver_types/fan/emission/flux", "5"},
    {"/transceiver_types/ring/emission", R"({ "type": "ies", "file": "a.ies" })"},
    {"/transceiver_types/ring/emission", R"({ "type": "ies", "flux": 1 })"},
    {"/transceiver_types/ring/emission", R"({ "type": "ies", "file": "", "flux": 1 })"},
    {"/transceiver_types/ring/emission", R"({ "type": "ies", "file": 3, "flux": 1 })"},
    {"/transceiver_types/ring/emission",
     R"({ "type": "ies", "file": ")" + photometry + "batwing.ies\", \"flux\": 0 }"},
    {"/transceiver_types/ring/emission", R"({ "type": "ldt", "file": "a.ldt", "flux": 1 })"},
    {"/transceiver_types/ring/emission", R"({ "type": "eulumdat", "file": "a.ldt", "flux": 1, "peak": 1 })"},
    {"/transceiver_types/down/radius", "10.1"},
    {"/transceiver_types/down/radius", "-0.1"},
    {"/transceiver_types/down/radius", "0.00009"},
    {"/transceiver_types/down/radius", "[0, 0]"},
    {"/transceiver_types/down/cost", "-4"},
    {"/transceiver_types/down/power", "4"},
    {"/fixtures", "{}"},
    {"/fixtures/0", "[]"},
    {"/fixtures/0/type", "\"gondla\""},
    {"/fixtures/0/type", ""},
    {"/fixtures/0/id", "\"\""},
    {"/fixtures/0/id", "\"tab\\tbed\""},
    {"/fixtures/0/id", ""},
    {"/fixtures/0/at", "[2, 1, 0]"},
    {"/fixtures/0/at/0", "10001"},
    {"/fixtures/0/length", "-3"},
    {"/fixtures/0/length", "1e4"},
    {"/fixtures/0/depth", "0.09"},
    {"/fixtures/0/height", ""},
    {"/fixtures/0/rotation_deg", "361"},
    {"/fixtures/0/rotation", "15"},
    {"/fixtures/0/material", ""},
    {"/fixtures/0/goods", "null"},
    {"/fixtures/0/shelves", ""},
    {"/fixtures/0/shelves", "[0.04]"},
    {"/fixtures/0/shelves", "0.4"},
    {"/fixtures/0/doors", "true"},
    {"/fixtures/1/doors", "[]"},
    {"/fixtures/2/doors", "\"white\""},
    {"/fixtures/0",
     R"({ "type": "gondola", "id": "A", "at": [2, 1], "length": 3, "depth": 0.9, "height": 0.29,
                         "material": "steel", "doors": "white", "shelves": [] })"},
    {"/fixtures/0/stocking", "1.1"},
    {"/fixtures/0/faces", "[]"},
    {"/fixtures/0/faces", "[\"front\", \"front\"]"},
    {"/fixtures/0/faces", "[\"left\"]"},
    {"/fixtures/0/labels", "[]"},
    {"/fixtures/0/labels/type", ""},
    {"/fixtures/0/labels/spacing", ""},
    {"/fixtures/0/labels/spacing", "0"},
    {"/fixtures/0/labels/faces", "[\"right\"]"},
    {"/fixtures/0/labels/faces", "\"front\""},
    {"/fixtures/0/labels/tilt_deg", "90"},
    {"/fixtures/0/labels/levels", "[1]"},
    {"/fixtures/1/length", "0.29"},
    {"/fixtures/1/height", "0.29"},
    {"/fixtures/1/shelves", "[0.4]"},
    {"/fixtures/1/labels/faces", "[\"top\"]"},
    {"/fixtures/2/min", "[7, 0]"},
    {"/fixtures/2/max", ""},
    {"/fixtures/2/stocking", "0.5"},
    {"/fixtures/3/file", "\"a.glb\""},
    {"/fixtures/3/materials", "{}"},
    {"/fixtures/3/up", "\"z\""},
    {"/fixtures/3/parts", ""},
    {"/fixtures/3/parts", "[]"},
    {"/fixtures/3/parts/0/name", ""},
    {"/fixtures/3/parts/0/vertices", "[]"},
    {"/fixtures/3/parts/0/vertices/0", "[0, 0]"},
    {"/fixtures/3/parts/0/faces", "[]"},
    {"/fixtures/3/parts/0/faces/0", "[0, 1]"},
    {"/fixtures/3/parts/0/faces/0", "[0, 1, -1]"},
    {"/fixtures/3/parts/0/faces/0", "[0, 1, 1.5]"},
    {"/fixtures/3/parts/0/normals", "[]"},
    {"/fixtures/3/at", "[6, 4]"},
    {"/fixtures/3/scale", "0"},
    {"/fixtures/3", R"({"type":"mesh","id":"M","at":[0,0,0]})"},
    {"/fixtures/3", R"({"type":"mesh","id":"M","at":[0,0,0],"file":"a.glb"})"},
    {"/fixtures/3", R"({"type":"mesh","id":"M","at":[0,0,0],"file":3,"materials":{"*":"tile"}})"},
    {"/fixtures/3", R"({"type":"mesh","id":"M","at":[0,0,0],"file":"","materials":{"*":"tile"}})"},
    {"/fixtures/3", R"({"type":"mesh","id":"M","at":[0,0,0],"file":"a.glb","materials":{"*":3}})"},
    {"/fixtures/3", R"({"type":"mesh","id":"M","at":[0,0,0],"file":"a.glb","materials":["tile"]})"},
    {"/fixtures/3",
     R"({"type":"mesh","id":"M","at":[0,0,0],"file":"a.glb","materials":{"*":"tile"},"up":"x"})"},
    {"/fixtures/3", R"({"type":"mesh","id":"M","file":"a.glb","materials":{"*":"tile"}})"},
    {"/labels", "{}"},
    {"/labels", "\"labels.csv\""},
    {"/labels", "{ \"csv\": \"\" }"},
    {"/labels/0/id", ""},
    {"/labels/0/position", "[1, 2, \"3\"]"},
    {"/labels/0/position", "[1, 2, 1e5]"},
    {"/labels/0/normal", ""},
    {"/labels/0/normal", "[0, 1]"},
    {"/labels/0/colour", "\"red\""},
    {"/transceivers", "[]"},
    {"/transceivers/grid", "[]"},
    {"/transceivers/grids", "{}"},
    {"/transceivers/grids/0/spacing", "0"},
    {"/transceivers/grids/0/spacing", "-1"},
    {"/transceivers/grids/0/z", ""},
    {"/transceivers/grids/0/z", "\"high\""},
    {"/transceivers/grids/0/min", "[1, 1, 1]"},
    {"/transceivers/grids/0/axis", "[0, -1]"},
    {"/transceivers/grids/0/id", "\"G\""},
    {"/transceivers/list", "3"},
    {"/transceivers/list/0/type", ""},
    {"/transceivers/list/0/roll_deg", "1e3"},
    {"/transceivers/list/0/direction", "[0, 0, -1]"},
    {"/transceivers/keep_out/0/min", ""},
    {"/transceivers/keep_out/0/z", "1"},
    {"/transceivers/installed", "\"T1\""},
    {"/transceivers/installed/0", "1"},
};

const std::vector<std::string> no_json = {
    "",        "null",          "[]",          "{",         "{} {}",           "{'name': 'x'}",
    "{\"a\"}", "{\"name\": x}", "{\"a\": 1,}", "// only a", "{\"name\": \"x}", "\xff\xfe{}",
};

// What only the reader can see, and what it says.
struct Semantic {
  Change change;
  std::string message;
};
const std::vector<Semantic> semantic = {
    {{"/room/floor", "\"Tile\""}, "room.floor: there is no material 'Tile'; did you mean 'tile'?"},
    {{"/fixtures/0/goods", "\"cartons\""}, "fixtures[0].goods: there is no material 'cartons'"},
    {{"/fixtures/1/doors", "\"glas\""}, "fixtures[1].doors: there is no material 'glas'"},
    {{"/fixtures/0/labels/type", "\"smal\""},
     "fixtures[0].labels.type: there is no label type 'smal'; did you"},
    {{"/labels/0/type", "\"down\""}, "labels[0].type: there is no label type 'down'"},
    {{"/transceivers/grids/0/type", "\"dawn\""},
     "transceivers.grids[0].type: there is no transceiver type 'dawn'; did you mean 'down'?"},
    {{"/fixtures/1/id", "\"A\""}, "fixtures[1]: the fixture id 'A' is used twice"},
    {{"/labels/0/id", "\"F-left-1-2\""},
     "labels[0]: the label id 'F-left-1-2' is used twice, first in store.json: fixtures[1]"},
    {{"/transceivers/list/1/id", "\"T1\""}, "transceivers.list[1]: the transceiver id 'T1' is used twice"},
    {{"/transceivers/list/1/id", "\"G1-2-2\""}, "list[1]: the transceiver id 'G1-2-2' is used twice"},
    {{"/labels/0/position", "[5, 2, 3.1]"},
     "labels[0]: label 'L1' at (5, 2, 3.1) is outside the room of 8 x 6"},
    {{"/fixtures/1/at", "[-0.5, 4]"}, "fixtures[1]: label 'F-left-1-1'"},
    {{"/transceivers/list/1/position", "[1, 3, 3.01]"}, "transceivers.list[1]: transceiver 'T2'"},
    {{"/transceivers/grids/0/z", "-1"}, "transceivers.grids[0]: transceiver 'G1-2-1'"},
    {{"/labels/0/normal", "[0, 0, 0]"}, "labels[0].normal: the direction is zero"},
    {{"/transceivers/grids/0/axis", "[0, 0, -0.0]"}, "transceivers.grids[0].axis: the direction is zero"},
    {{"/fixtures/2/max", "[6, 0.5, 3]"}, "fixtures[2].max: is not above 'min'"},
    {{"/transceivers/grids/0/max", "[0, 5]"}, "transceivers.grids[0].max: is below 'min'"},
    {{"/transceivers/keep_out/0/max", "[-1, 5]"}, "transceivers.keep_out[0].max: is below 'min'"},
    {{"/transceivers/grids/0/spacing", "0.001"}, "transceivers.grids[0].spacing: makes a grid of"},
    {{"/transceivers/installed/0", "\"T3\""},
     "transceivers.installed[0]: there is no transceiver 'T3'; list it"},
    {{"/transceivers/installed/0", "\"G1-1-1\""}, "it lies in a 'keep_out' area"},
    {{"/transceivers", "{}"}, "has no candidate transceivers"},
    {{"/transceivers/keep_out/0/max", "[8, 6]"}, "has no candidate transceivers"},
    {{"/fixtures/0/shelves", "[0.4, 0.44]"}, "fixtures[0].shelves[1]: is not at least 0.05 m above"},
    {{"/fixtures/0/shelves", "[0.4, 1.8]"},
     "fixtures[0].shelves[1]: is at 1.8 m, not below the height 1.8 m"},
    {{"/fixtures/0/shelves", "[]"}, "fixtures[0].labels: has no boards"},
    {{"/fixtures/0/faces", "[\"front\"]"}, "fixtures[0].labels.faces: names a face that has no boards"},
    {{"/fixtures/3/parts/0/faces/1", "[0, 1, 4]"},
     "fixtures[3].parts[0].faces[1][2]: is 4, which is outside"},
    {{"/fixtures/3/scale", "1e6"}, "fixtures[3]: reaches 1e+06 m from its 'at'"},
    {{"/materials/foil", R"({ "type": "conductor", "eta": 0, "k": 0 })"},
     "materials.foil: has eta and k of 0"},
    {{"/label_types/deep/threshold/hears", "\"dawn\""},
     "label_types.deep.threshold.hears: there is no transceiver type 'dawn'; did you mean 'down'?"},
    {{"/label_types/deep/threshold/angle_deg", ""},
     "label_types.deep.threshold: 'down' emits nothing at 0 degrees from its axis; give the 'angle_deg'"},
    {{"/label_types/measured/threshold/angle_deg", "121"},
     "label_types.measured.threshold: 'fan' emits nothing at 121 degrees"},
    {{"/label_types/measured/responsivity/response", "[0, 1, 0]"},
     "label_types.measured.threshold: a label of this type hears nothing from straight ahead"},
    {{"/label_types/measured/responsivity/response", "[0, 0, 0]"},
     "label_types.measured.responsivity: hears nothing; give it some response"},
    {{"/label_types/measured/responsivity/response", "[1, 0]"}, "response: has 2 values for 3 angles"},
    {{"/label_types/measured/responsivity/theta_deg", "[10, 40, 75]"}, "theta_deg: does not begin at 0"},
    {{"/label_types/measured/responsivity/theta_deg", "[0, 75, 40]"}, "theta_deg: does not ascend"},
    {{"/transceiver_types/fan/emission/phi_deg", "[1, 90, 200]"}, "phi_deg: does not begin at 0"},
    {{"/transceiver_types/ring/emission/theta_deg", "[0, 89, 89.00000000000001]"},
     "theta_deg: does not ascend"},
    {{"/transceiver_types/ring/emission", R"({ "type": "ies", "file": "none.ies", "flux": 1 })"},
     "transceiver_types.ring.emission.file: the file 'none.ies' does not exist"},
    {{"/transceiver_types/ring/emission/theta_deg", "[0, 30, 30]"}, "theta_deg: does not ascend"},
    {{"/transceiver_types/ring/emission/intensity", "[1, 2]"}, "intensity: has 2 values for 3 angles"},
    {{"/transceiver_types/ring/emission/intensity", "[0, 0, 0]"}, "emission: emits nothing"},
    {{"/transceiver_types/fan/emission/phi_deg", "[0, 10]"}, "intensity: has 3 rows for 2 values of phi"},
    {{"/labels", "{ \"csv\": \"none.csv\" }"}, "labels.csv: the file 'none.csv' does not exist"},
    {{"/transceivers/list", "{ \"csv\": \"none.csv\" }"}, "transceivers.list.csv: the file"},
    {{"/fixtures/3", R"({"type":"mesh","id":"M","file":"none.glb","at":[0,0,0],"materials":{}})"},
     "fixtures[3].file: the mesh 'none.glb' does not exist"},
};

std::string reader_verdict(const std::string& text) {
  try {
    // Where files may lie is no matter of the schema.
    make_scene(parse_store(text, "store.json", {}, StoreTrust{.allow_outside = true}));
    return "ok";
  } catch (const InputError& error) {
    return error.what();
  }
}

class Schema : public testing::Test {
 protected:
  // What the schema says of each text: "ok", or "bad: " and why.
  std::vector<std::string> verdicts(const std::vector<std::string>& texts) {
    std::vector<std::string> command{"/usr/bin/python3",
                                     SHELFBEAM_SOURCE_DIR "/test/unit/scene/check_schema.py",
                                     SHELFBEAM_SOURCE_DIR "/data/store.schema.json"};
    for (std::size_t i = 0; i < texts.size(); ++i)
      command.push_back(folder.write(std::to_string(i) + ".json", texts[i]).string());
    const test::Outcome outcome = test::run(command);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    std::vector<std::string> lines;
    std::istringstream out(outcome.out);
    for (std::string line; std::getline(out, line);) lines.push_back(line);
    EXPECT_EQ(lines.size(), texts.size());
    lines.resize(texts.size());
    return lines;
  }
  std::vector<std::string> verdicts(const std::vector<Change>& changes) {
    std::vector<std::string> texts;
    texts.reserve(changes.size());
    for (const auto& [pointer, value] : changes) texts.push_back(changed_store(pointer, value).dump());
    return verdicts(texts);
  }
  TempFolder folder;
};

std::string text_of(const Change& change) {
  return changed_store(change.pointer, change.value).dump();
}

// "/fixtures/0/labels/type" -> "fixtures[0].labels", in the reader's spelling.
std::string parent_place(const std::string& pointer) {
  std::string place;
  std::istringstream parts(pointer.substr(1, std::max<std::size_t>(pointer.rfind('/'), 1) - 1));
  for (std::string part; std::getline(parts, part, '/');)
    place += part.find_first_not_of("0123456789") == std::string::npos ? "[" + part + "]"
                                                                       : (place.empty() ? "" : ".") + part;
  return place;
}

TEST_F(Schema, AcceptsWhatTheReaderAccepts) {
  ASSERT_EQ(reader_verdict(sample_store().dump()), "ok");
  const auto lines = verdicts(good);
  for (std::size_t i = 0; i < good.size(); ++i) {
    EXPECT_EQ(lines[i], "ok") << good[i].pointer << " = " << good[i].value;
    EXPECT_EQ(reader_verdict(text_of(good[i])), "ok") << good[i].pointer << " = " << good[i].value;
  }
}

TEST_F(Schema, RejectsWhatTheReaderRejects) {
  const auto lines = verdicts(bad);
  for (std::size_t i = 0; i < bad.size(); ++i) {
    EXPECT_TRUE(lines[i].starts_with("bad: ")) << bad[i].pointer << " = " << bad[i].value;
    const std::string message = reader_verdict(text_of(bad[i]));
    EXPECT_TRUE(message.starts_with("store.json: " + parent_place(bad[i].pointer)))
        << bad[i].pointer << " = " << bad[i].value << ": " << message;
  }
}

TEST_F(Schema, AndReaderRefuseWhatIsNoJson) {
  std::vector<std::string> texts = no_json;
  for (const std::string value : {"NaN", "Infinity", "-Infinity", "1e999", "0x10", "+1", "1.", "01"}) {
    std::string text = sample_store().dump();
    text.replace(text.find("950"), 3, value);
    texts.push_back(text);
  }
  const auto lines = verdicts(texts);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    EXPECT_TRUE(lines[i].starts_with("bad: ")) << texts[i];
    EXPECT_TRUE(reader_verdict(texts[i]).starts_with("store.json: ")) << reader_verdict(texts[i]);
  }
}

TEST_F(Schema, LeavesSomeErrorsToTheReader) {
  std::vector<Change> changes;
  changes.reserve(semantic.size());
  for (const Semantic& one : semantic) changes.push_back(one.change);
  const auto lines = verdicts(changes);
  for (std::size_t i = 0; i < changes.size(); ++i) {
    EXPECT_EQ(lines[i], "ok") << changes[i].pointer << " = " << changes[i].value;
    const std::string message = reader_verdict(text_of(changes[i]));
    EXPECT_TRUE(message.starts_with("store.json: ")) << message;
    EXPECT_NE(message.find(semantic[i].message), std::string::npos)
        << changes[i].pointer << " = " << changes[i].value << ": " << message;
  }
  // Python takes the last of two equal keys.
  std::string twice = sample_store().dump();
  twice.replace(twice.find("\"name\""), 6, "\"name\":\"first\",\"name\"");
  EXPECT_EQ(verdicts(std::vector<std::string>{twice})[0], "ok");
  EXPECT_EQ(reader_verdict(twice), "store.json: name: stands twice in its object; remove one of them");
}

TEST_F(Schema, AcceptsExamplesAndResolvedStores) {
  const Store store = test::read_text(sample_store().dump());
  std::vector<std::string> texts{resolved_store_json(store, make_scene(store))};
  for (const auto& example : std::filesystem::directory_iterator(SHELFBEAM_SOURCE_DIR "/examples")) {
    const auto file = example.path() / "store.json";
    texts.push_back(read_file(file));
    const Store read = read_store(file);
    texts.push_back(resolved_store_json(read, make_scene(read)));
  }
  for (const std::string& line : verdicts(texts)) EXPECT_EQ(line, "ok");
}

}  // namespace
}  // namespace shelfbeam
