// Stores with one mistake each. A planner must hear of it before any simulation.

#include <nlohmann/json.hpp>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/inspection/checks.hpp"
#include "shelfbeam/inspection/plausibility.hpp"
#include "shelfbeam/scene/store/store.hpp"

#include "support/documentation.hpp"
#include "support/small_store.hpp"
#include "support/testing.hpp"

namespace shelfbeam::test {
namespace {

using Json = nlohmann::ordered_json;

constexpr auto chiller = SHELFBEAM_SOURCE_DIR "/examples/chiller";

using Place = std::array<double, 3>;

Json& by_id(Json& list, const std::string& id) {
  for (Json& item : list)
    if (item["id"] == id) return item;
  throw std::out_of_range(id);
}

Json label(const std::string& id, const Place& position, const Place& normal) {
  return {{"id", id}, {"position", position}, {"normal", normal}, {"type", "shelf"}};
}

Json box(const std::string& id, const Place& min, const Place& max) {
  return {{"type", "box"}, {"id", id}, {"min", min}, {"max", max}, {"material", "wall"}};
}

Json column(const std::string& id, double x, double y) {
  return box(id, {x - 0.2, y - 0.2, 0}, {x + 0.2, y + 0.2, 3.2});
}

using Make = std::function<void(Json&)>;

// The store of a shop with one mistake.
struct Mistake {
  std::string name;
  Make make;              // puts the mistake into the good store
  std::string says = {};  // a part of the warning or error
};

// The value at a path such as "fixtures/A1/at": elements of lists by their number or their id, and "units"
// for those of transceivers.
Json& at(Json& store, const std::string& path) {
  if (path.starts_with("units/")) return at(store, "transceivers/list/" + path.substr(6));
  Json* value = &store;
  std::istringstream names(path);
  for (std::string name; std::getline(names, name, '/');) {
    const bool is_number = name.find_first_not_of("0123456789") == std::string::npos;
    value = !value->is_array() ? &(*value)[name]
            : is_number        ? &(*value)[std::stoul(name)]
                               : &by_id(*value, name);
  }
  return *value;
}

Make set(const std::string& path, const Json& value) {
  return [=](Json& store) { at(store, path) = value; };
}
Make add(const std::string& path, const Json& value) {
  return [=](Json& store) { at(store, path).push_back(value); };
}
Make all(const std::vector<Make>& changes) {
  return [=](Json& store) {
    for (const Make& change : changes) change(store);
  };
}

// The position of every listed label through `change`.
void move_labels(Json& store, const std::function<Place(const Place&)>& change) {
  for (Json& one : store["labels"]) one["position"] = change(one["position"].get<Place>());
}

void scale_labels(Json& store, double factor) {
  move_labels(store, [&](const Place& p) { return Place{p[0] * factor, p[1] * factor, p[2] * factor}; });
}

void add_copy(Json& list, Json of, const char* id) {
  of["id"] = id;
  list.push_back(std::move(of));
}

// A store room of 1.2 x 1 m without a door, at the shop window.
void add_closed_room(Json& store) {
  store["fixtures"].push_back(box("west", {3.9, 0, 0}, {3.95, 1, 3.2}));
  store["fixtures"].push_back(box("north", {3.9, 1, 0}, {5.1, 1.05, 3.2}));
  store["fixtures"].push_back(box("east", {5.05, 0, 0}, {5.1, 1, 3.2}));
}

// A closed column or wall as a mesh, of which the program knows triangles only, and no block.
Json mesh_column(double x, double y, double half_length = 0.2) {
  constexpr double r = 0.2, height = 3.2;
  const double l = half_length;
  Json vertices = Json::array(), faces = Json::array();
  for (const double z : {0.0, height})
    for (const auto& [dx, dy] : {std::pair(-r, -l), std::pair(r, -l), std::pair(r, l), std::pair(-r, l)})
      vertices.push_back({dx, dy, z});
  for (const auto& [a, b, c, d] : std::vector<std::array<int, 4>>{
           {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {3, 2, 1, 0}, {4, 5, 6, 7}}) {
    faces.push_back({a, b, c});
    faces.push_back({a, c, d});
  }
  const Json shaft{{"name", "shaft"}, {"material", "wall"}, {"vertices", vertices}, {"faces", faces}};
  return {{"type", "mesh"}, {"id", "mesh column"}, {"at", {x, y, 0}}, {"parts", Json::array({shaft})}};
}

// A small shop with meshes, glass, two types of units and a list of labels. Its files are in the folder.
Json good_store() {
  Json store = Json::parse(read_file(std::string(chiller) + "/store.json"), nullptr, true, true);
  // Smooth materials take no time to prepare, and the checks are about other things.
  for (auto& [name, material] : store["materials"].items())
    for (const char* key : {"roughness", "distribution"}) material.erase(key);
  // A list of labels on the narrow wall shelving; their x is greater than the width of the room.
  for (int k = 0; k < 8; ++k)
    store["labels"].push_back(label("wall-" + std::to_string(k), {11.598, 1.3 + 0.3 * k, 1.55}, {-1, 0, 0}));
  return store;
}

// Mistakes of the kinds for which checks were written.
std::vector<Mistake> expected_mistakes() {
  return {
      {"a label type hears at 500 m", set("label_types/shelf/threshold/at_m", 500)},
      {"a label type hears slightly beyond the room", set("label_types/shelf/threshold/at_m", 16)},
      {"a threshold in milliwatts", set("label_types/cooler/threshold", 10)},
      {"a threshold in kilowatts", set("label_types/cooler/threshold", 1e-5)},
      {"label types that differ by a factor of 150", set("label_types/cooler/threshold", 1.0)},
      {"a flux in milliwatts", set("transceiver_types/ring/emission/flux", 1000)},
      {"a flux in kilowatts", set("transceiver_types/ring/emission/flux", 5e-4)},
      {"a label in mid-air", set("labels/0/position", {6, 2.2, 1.2})},
      {"a label in mid-air within the hull of a mesh",
       set("labels/0", label("mid-air", {10.5, 2.3, 1.2}, {0, 0, 1}))},
      {"a label turned to its fixture", set("labels/0/normal", {0, 1, -0.3})},
      {"a label turned to a mesh", all({add("fixtures", mesh_column(7.5, 2.2)),
                                        add("labels", label("turned", {7.26, 2.2, 1.2}, {1, 0, 0}))})},
      {"a label in a closed store room",
       all({add_closed_room, add("labels", label("inside", {4.5, 0.99, 1.2}, {0, -1, 0}))})},
      {"a label inside a mesh column", all({add("fixtures", mesh_column(7.5, 2.2)),
                                            add("labels", label("inside", {7.31, 2.2, 1.2}, {1, 0, 0}))})},
      {"two labels at one place", [](Json& s) { add_copy(s["labels"], s["labels"][3], "copy"); }},
      {"labels with x and y exchanged",
       [](Json& s) { move_labels(s, [](const Place& p) { return Place{p[1], p[0], p[2]}; }); },
       "x and y look exchanged"},
      {"labels with y and z exchanged",
       [](Json& s) { move_labels(s, [](const Place& p) { return Place{p[0], p[2], p[1]}; }); },
       "y and z look exchanged"},
      {"labels in millimetres", [](Json& s) { scale_labels(s, 1000); }},
      {"labels in centimetres", [](Json& s) { scale_labels(s, 100); }, "look like centimetres"},
      {"labels in feet", [](Json& s) { scale_labels(s, 1 / 0.3048); }, "look like feet"},
      {"units aimed up into the ceiling", set("transceivers/grids/0/axis", {0, 0, 1})},
      {"a unit aimed into the wall behind it", set("units/wall-west-2/axis", {-0.819, 0, -0.574})},
      {"a unit inside a column", add("fixtures", column("column", 7.2, 2.4))},
      {"a unit inside a mesh column", add("fixtures", mesh_column(7.2, 2.4))},
      {"a ceiling unit 1 m above the floor", set("units/over-till/position", {10.6, 2.6, 1.0})},
      {"a grid of units at the height of a counter", set("transceivers/grids/1/z", 0.9)},
      {"a unit in a closed store room",
       all({add_closed_room, set("units/over-till/position", {4.5, 0.5, 3.15})})},
      {"a gondola inside another", set("fixtures/A2/at", {2.5, 3.3})},
      {"a gondola through the wall", set("fixtures/A1/at", {-1, 3.1})},
      {"a mesh inside a gondola", set("fixtures/till/at", {3.5, 3.3, 0})},
      {"a gondola through a wall that is a mesh", add("fixtures", mesh_column(6.8, 3.5, 2))},
      {"a room of 32 m height", set("room/size/2", 32)},
      {"a room of 1.9 m height",
       [](Json& s) {
         s["room"]["size"][2] = 1.9;
         for (Json& grid : s["transceivers"]["grids"]) grid["z"] = 1.85;
         for (Json& one : s["transceivers"]["list"]) one["position"][2] = 1.8;
         s["fixtures"].erase(9);
         s["materials"].erase("mirror");
         for (const char* id : {"C1", "T1"}) by_id(s["fixtures"], id)["height"] = 1.85;
       }},
      {"a mesh in millimetres", set("fixtures/till/scale", 1000)},
      {"a mesh a thousand times too small", set("fixtures/till/scale", 0.001)},
      {"a reflectance of 0.99", set("materials/wall/reflectance", 0.99)},
      {"a material that nothing uses", set("materials/wood", {{"type", "lambertian"}, {"reflectance", 0.5}})},
      {"a label type that nothing uses", set("label_types/old", {{"threshold", 0.01}})},
      {"a transceiver type that nothing uses",
       set("transceiver_types/old", {{"emission", {{"type", "lambertian"}, {"flux", 1}}}})},
  };
}

// Mistakes of other kinds, written down before any check of plausibility existed.
std::vector<Mistake> other_mistakes() {
  return {
      {"a safety factor of 0.125 instead of 1.25", set("label_types/shelf/safety_factor", 0.125)},
      {"the wavelength of visible light", set("wavelength_nm", 490)},
      {"a label of 6 x 3 m", set("label_types/cooler/size", {6, 3})},
      {"a unit with a radius of 3 m", set("transceiver_types/spot/radius", 3)},
      {"the same candidate twice",
       [](Json& s) { add_copy(s["transceivers"]["list"], at(s, "units/wall-east-1"), "copy"); }},
      {"a keep-out area in millimetres",
       set("transceivers/keep_out/0", {{"min", {5400, 0}}, {"max", {7800, 1500}}})},
      {"labels every 5 mm", set("fixtures/A1/labels/spacing", 0.005)},
      {"a label that faces the floor", set("labels/0/normal", {0, 0, -1})},
      {"a label just below the ceiling", add("labels", label("high", {0.01, 1.5, 3.1}, {1, 0, 0}))},
      {"a grid with one candidate per corner of the shop",
       [](Json& s) {
         for (Json& grid : s["transceivers"]["grids"]) grid["spacing"] = 12;
         s["transceivers"]["list"] = {at(s, "units/over-till")};
       }},
      {"an aisle of 20 cm", set("fixtures/A2/at", {2, 4.2})},
      {"units that cost nothing", set("transceiver_types/spot/cost", 0)},
      {"units without a price beside others with one",
       [](Json& s) {
         s["currency"] = "EUR";
         for (Json& type : s["transceiver_types"]) type["cost"] = 25;
         s["transceiver_types"]["spot"].erase("cost");
       }},
      {"reflectances in per cent of per cent", set("materials/wall/reflectance", 0.008)},
      {"a counter that floats 1 m above the floor",
       all({set("fixtures/coffee/min", {0.1, 8.3, 1.0}), set("fixtures/coffee/max", {2.8, 8.95, 1.95})})},
      {"a cutoff angle in radians", set("label_types/cooler/responsivity/cutoff_deg", 1.309)},
      {"a rotation in radians", set("fixtures/A3/rotation_deg", 1.5708)},
      {"panes with a thickness in millimetres", set("materials/door/thickness", 6)},
      {"a label listed again, 4 mm beside", add("labels", label("again", {11.598, 1.304, 1.55}, {-1, 0, 0}))},
  };
}

// Changes after which the store is unusual, but plausible.
std::vector<Mistake> plausible_changes() {
  return {
      {"as it is", [](Json&) {}},
      {"walls that join beside a door", set("room/inner_walls", Json::parse(R"([
          {"id": "W1", "from": [0.3, 0.5], "to": [1.5, 0.5], "thickness": 0.12},
          {"id": "W2", "from": [1.5, 0.5], "to": [1.5, 1.5], "thickness": 0.12,
           "openings": [{"at": 0.06, "width": 0.7, "top": 2.1}]}])"))},
      {"a warehouse ceiling of 9 m", all({set("room/size/2", 9), set("fixtures/mirror/at/2", 2.75)})},
      {"units suspended 60 cm below the ceiling",
       [](Json& s) {
         for (Json& grid : s["transceivers"]["grids"]) grid["z"] = 2.6;
       }},
      {"a low unit on the wall that points into the room",
       all({set("units/wall-west-1/position", {0.05, 1.2, 1.2}), set("units/wall-west-1/axis", {1, 0, 0})})},
      {"a sign with a label on either side",
       all({add("labels", label("sign-front", {9.0, 0.2, 1.4}, {0, 1, 0})),
            add("labels", label("sign-back", {9.0, 0.19, 1.4}, {0, -1, 0})),
            add("fixtures", box("sign", {8.9, 0.191, 1.3}, {9.1, 0.199, 1.5}))})},
      {"a label on a rail 20 cm in front of the shelf",
       add("labels", label("rail", {3, 2.9, 1.0}, {0, -1, 0}))},
      {"columns and walls that meet in corners",
       [](Json& s) {
         s["fixtures"].push_back(box("office west", {8.8, 7.9, 0}, {8.9, 9, 3.2}));
         s["fixtures"].erase(0);  // the coolers, which stand there
         s["fixtures"].push_back(box("office south", {8.8, 7.9, 0}, {10.4, 8.0, 2.4}));
         for (Json& grid : s["transceivers"]["grids"]) grid["max"] = {10.8, 6.0};
         s["materials"].erase("bottles");
         s["label_types"].erase("cooler");
       }},
      {"a column between the aisles", add("fixtures", mesh_column(7.9, 2.6))},
      {"a column in a shelf, as a mesh", add("fixtures", mesh_column(6.8, 3.5))},
      {"a column in a shelf, below a ceiling that is lower than others",
       all({set("room/zones", Json::parse(R"([{"id": "high", "polygon": [[0, 0], [2, 0], [2, 1], [0, 1]],
                                               "height": 5}])")),
            add("fixtures", column("column", 6.8, 3.5))})},
      {"a column in a wall", all({add("fixtures", box("partition", {10.22, 6.05, 0}, {10.32, 7.55, 3.2})),
                                  add("fixtures", box("column", {10.24, 6.4, 0}, {10.32, 6.6, 3.2}))})},
      {"a stronger unit", set("transceiver_types/ring/emission/flux", 3)},
      {"less sensitive labels", set("label_types/shelf/threshold/at_m", 4)},
      {"two prices", set("transceiver_types/spot/cost", 25.5)},
      {"two units at one point with different axes",
       [](Json& s) {
         add_copy(s["transceivers"]["list"], at(s, "units/wall-east-1"), "other axis");
         s["transceivers"]["list"].back()["axis"] = {-0.7, 0.3, -0.574};
       }},
  };
}

// The warnings about a store, or the error that refuses it.
std::vector<std::string> objections(const Mistake& mistake) {
  Json store = good_store();
  mistake.make(store);
  try {
    return sentences(make_inspected_scene(parse_store(store.dump(), "store.json", chiller)).warnings);
  } catch (const InputError& refused) {
    return {refused.what()};
  }
}

std::vector<std::string> unnoticed(const std::vector<Mistake>& mistakes) {
  std::vector<std::string> names;
  for (const Mistake& mistake : mistakes)
    if (!testing::Value(objections(mistake), testing::Contains(testing::HasSubstr(mistake.says))))
      names.push_back(mistake.name);
  return names;
}

TEST(Mistakes, AreNoticed) {
  EXPECT_EQ(expected_mistakes().size(), 38u);
  EXPECT_EQ(other_mistakes().size(), 19u);
  EXPECT_THAT(unnoticed(expected_mistakes()), testing::IsEmpty());
  EXPECT_THAT(unnoticed(other_mistakes()), testing::IsEmpty());
}

TEST(Mistakes, ReceiversOfAMeasuringPlaneAreInMidAir) {
  const Make plane =
      set("measuring_planes", Json::parse(R"([{"id": "P", "type": "shelf", "origin": [6, 2, 1.2],
      "axes": [[1, 0, 0], [0, 1, 0]], "size": [0.4, 0.4], "counts": [1, 1]}])"));
  EXPECT_THAT(objections({"", plane}), testing::IsEmpty());
  const Make label = all({set("labels/0/position", {6.2, 2.2, 1.2}), set("labels/0/normal", {0, 0, 1})});
  EXPECT_THAT(objections({"", label}), testing::Not(testing::IsEmpty())) << "negative control: a label there";
}

TEST(Mistakes, OfLabelsNameTheArticleBeforeTheId) {
  const std::vector<Mistake> mistakes = expected_mistakes();
  for (const auto& [name, sentence] :
       {std::pair("a label in mid-air", "label 'Rye bread' \\(.*\\) at .* has no surface"),
        std::pair("a label in a closed store room", "label 'Rye bread' \\(inside\\) at .* is separated from"),
        std::pair("two labels at one place",
                  "label 'Rye bread' \\(copy\\) .* mm from label 'Rye bread' \\(")}) {
    const Make describe = [](Json& store) {
      for (Json& label : store["labels"]) label["description"] = "Rye bread";
    };
    const Make make = std::ranges::find(mistakes, name, &Mistake::name)->make;
    EXPECT_THAT(objections({name, all({make, describe})}),
                testing::Contains(testing::ContainsRegex(sentence)));
  }
}

TEST(Mistakes, SpacingsOfAllGeneratedCandidatesAreChecked) {
  const Json areas = Json::parse(R"({"areas": [{"type": "spot", "area": "room", "z": 2.9}]})");
  const Json rails =
      Json::parse(R"({"rails": [{"type": "spot", "id": "R", "points": [[1, 3, 2.9], [4, 3, 2.9]]}]})");
  for (const Json& candidates : {areas, rails})
    for (const double spacing : {0.2, 1.0, 9.0}) {
      const std::string place = "transceivers/" + candidates.begin().key() + "/0/spacing";
      const auto found = objections({"", all({set("transceivers", candidates), set(place, spacing)})});
      const std::string warning = fmt::format("transceivers.{}[0].spacing: is {} m; 0.5 to 3 m are typical",
                                              candidates.begin().key(), spacing);
      const auto has_warning = testing::Contains(testing::HasSubstr(warning));
      EXPECT_EQ(testing::Value(found, has_warning), spacing != 1) << warning;
    }
}

TEST(Mistakes, PlausibleChangesAreAccepted) {
  for (const Mistake& change : plausible_changes())
    EXPECT_THAT(objections(change), testing::IsEmpty()) << change.name;
}

TEST(Mistakes, UnusedPartsOfCataloguesAreNone) {
  const TempFolder folder;
  const Json more = Json::parse(R"({
    "materials": { "wood": { "type": "lambertian", "reflectance": 0.5 } },
    "label_types": { "old": { "threshold": 0.02 } },
    "transceiver_types": { "old": { "emission": { "type": "lambertian", "flux": 1 } } } })");
  folder.write("chain.json", more.dump());
  const auto warnings = [&](const Json& store) {
    return sentences(make_inspected_scene(parse_store(store.dump(), "store.json", folder.path())).warnings);
  };
  SmallStore small;
  small.labels.clear();
  Json store = Json::parse(small.text());
  EXPECT_THAT(warnings(store), testing::IsEmpty());
  Json shared = store;
  shared["catalogues"] = {"chain.json"};
  EXPECT_THAT(warnings(shared), testing::IsEmpty());
  for (const auto& [section, parts] : more.items()) store[section].update(parts);
  EXPECT_THAT(warnings(store), testing::SizeIs(3));
}

TEST(Mistakes, ChecksCanBeCancelled) {
  CancelToken token;
  Store store = parse_store(good_store().dump(), "store.json", chiller);
  store.cancel = &token;
  const Scene scene = make_scene(store);
  const DeviceSources sources{std::vector<std::string>(scene.fixtures.size()),
                              std::vector<std::string>(scene.labels.size()),
                              std::vector<std::string>(scene.transceivers.size()),
                              {}};
  const Inspected inspected(store, scene, sources);
  token.request();
  WarningList warnings(store.file, store.ignored);
  EXPECT_THROW(warn_of_fixtures(inspected, warnings), Interrupted);
  EXPECT_THROW(warn_of_labels(inspected, warnings), Interrupted);
  EXPECT_THROW(warn_of_units(inspected, warnings), Interrupted);
  EXPECT_THROW(warn_of_separated(inspected, warnings), Interrupted);
}

void expect_no_warnings(const Scene& scene) {
  EXPECT_THAT(sentences(scene.warnings), testing::IsEmpty());
}

Scene example(const char* name) {
  return make_inspected_scene(
      read_store(fmt::format("{}/examples/{}/store.json", SHELFBEAM_SOURCE_DIR, name)));
}

TEST(Mistakes, ExamplesHaveNone) {
  for (const char* name : {"thesis", "grocery", "chiller", "market-hall", "supermarket"})
    expect_no_warnings(example(name));
}

TEST(MistakesSlow, HypermarketHasNone) {
  expect_no_warnings(example("hypermarket"));
}

TEST(Mistakes, DocumentedExamplesHaveNone) {
  const auto documented = [](const std::string& page) {
    return Json::parse(fenced_blocks(page, "jsonc").at(0), nullptr, true, true);
  };
  const auto expect_none = [](const Json& store) {
    expect_no_warnings(make_inspected_scene(parse_store(store.dump(), "store.json", {})));
  };
  const Json kiosk = documented("store.md");
  expect_none(kiosk);
  Json fixtures = kiosk;
  fixtures.update(documented("store/fixtures.md"));
  expect_none(fixtures);
  Json transceivers = kiosk;
  transceivers["transceivers"] = documented("store/transceivers.md");
  expect_none(transceivers);
  Json variation = kiosk;
  variation.update(documented("store/variation.md"));
  variation["variation"].erase("doors");  // of chillers, which the kiosk lacks
  variation["materials"]["clothes"] = {{"type", "lambertian"}, {"reflectance", 0.4}};
  expect_none(variation);
}

}  // namespace
}  // namespace shelfbeam::test
