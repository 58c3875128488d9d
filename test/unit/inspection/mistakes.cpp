#include "unit/inspection/mistakes.hpp"

#include <array>
#include <stdexcept>
#include <utility>

#include "shelfbeam/base/file.hpp"

namespace shelfbeam::test {

namespace {

Json& by_id(Json& list, const std::string& id) {
  for (Json& item : list)
    if (item["id"] == id) return item;
  throw std::out_of_range(id);
}

Json& fixture(Json& store, const std::string& id) {
  return by_id(store["fixtures"], id);
}

Json& unit(Json& store, const std::string& id) {
  return by_id(store["transceivers"]["list"], id);
}

Json label(const std::string& id, const std::array<double, 3>& position,
           const std::array<double, 3>& normal) {
  return {{"id", id}, {"position", position}, {"normal", normal}, {"type", "shelf"}};
}

Json box(const std::string& id, const std::array<double, 3>& min, const std::array<double, 3>& max) {
  return {{"type", "box"}, {"id", id}, {"min", min}, {"max", max}, {"material", "wall"}};
}

Json column(const std::string& id, double x, double y) {
  return box(id, {x - 0.2, y - 0.2, 0}, {x + 0.2, y + 0.2, 3.2});
}

// The position of every listed label through `change`.
template <class Change>
void move_labels(Json& store, Change change) {
  for (Json& one : store["labels"]) {
    const auto p = one["position"].get<std::array<double, 3>>();
    one["position"] = change(p);
  }
}

void scale_labels(Json& store, double factor) {
  move_labels(store, [&](const std::array<double, 3>& p) {
    return std::array{p[0] * factor, p[1] * factor, p[2] * factor};
  });
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

}  // namespace

Json good_store() {
  Json store =
      Json::parse(read_file(SHELFBEAM_SOURCE_DIR "/examples/chiller/store.json"), nullptr, true, true);
  // Smooth materials take no time to prepare, and the checks are about other things.
  for (auto& [name, material] : store["materials"].items())
    for (const char* key : {"roughness", "distribution"}) material.erase(key);
  // A list of labels on the narrow wall shelving; their x is greater than the width of the room.
  for (int k = 0; k < 8; ++k)
    store["labels"].push_back(label("wall-" + std::to_string(k), {11.598, 1.3 + 0.3 * k, 1.55}, {-1, 0, 0}));
  return store;
}

std::vector<Mistake> expected_mistakes() {
  return {
      {"a label type hears at 500 m", [](Json& s) { s["label_types"]["shelf"]["threshold"]["at_m"] = 500; }},
      {"a label type hears slightly beyond the room",
       [](Json& s) { s["label_types"]["shelf"]["threshold"]["at_m"] = 16; }},
      {"a threshold in milliwatts", [](Json& s) { s["label_types"]["cooler"]["threshold"] = 10; }},
      {"a threshold in kilowatts", [](Json& s) { s["label_types"]["cooler"]["threshold"] = 1e-5; }},
      {"label types that differ by a factor of 150",
       [](Json& s) { s["label_types"]["cooler"]["threshold"] = 1.0; }},
      {"a flux in milliwatts", [](Json& s) { s["transceiver_types"]["ring"]["emission"]["flux"] = 1000; }},
      {"a flux in kilowatts", [](Json& s) { s["transceiver_types"]["ring"]["emission"]["flux"] = 5e-4; }},
      {"a label in mid-air", [](Json& s) { s["labels"][0]["position"] = {6, 2.2, 1.2}; }},
      {"a label in mid-air within the hull of a mesh",
       [](Json& s) { s["labels"][0] = label("mid-air", {10.5, 2.3, 1.2}, {0, 0, 1}); }},
      {"a label turned to its fixture", [](Json& s) { s["labels"][0]["normal"] = {0, 1, -0.3}; }},
      {"a label turned to a mesh",
       [](Json& s) {
         s["fixtures"].push_back(mesh_column(7.5, 2.2));
         s["labels"].push_back(label("turned", {7.26, 2.2, 1.2}, {1, 0, 0}));
       }},
      {"a label in a closed store room",
       [](Json& s) {
         add_closed_room(s);
         s["labels"].push_back(label("inside", {4.5, 0.99, 1.2}, {0, -1, 0}));
       }},
      {"a label inside a mesh column",
       [](Json& s) {
         s["fixtures"].push_back(mesh_column(7.5, 2.2));
         s["labels"].push_back(label("inside", {7.31, 2.2, 1.2}, {1, 0, 0}));
       }},
      {"two labels at one place",
       [](Json& s) {
         s["labels"].push_back(s["labels"][3]);
         s["labels"].back()["id"] = "copy";
       }},
      {"labels with x and y exchanged",
       [](Json& s) {
         move_labels(s, [](const std::array<double, 3>& p) { return std::array{p[1], p[0], p[2]}; });
       }},
      {"labels with y and z exchanged",
       [](Json& s) {
         move_labels(s, [](const std::array<double, 3>& p) { return std::array{p[0], p[2], p[1]}; });
       }},
      {"labels in millimetres", [](Json& s) { scale_labels(s, 1000); }},
      {"labels in centimetres", [](Json& s) { scale_labels(s, 100); }},
      {"labels in feet", [](Json& s) { scale_labels(s, 1 / 0.3048); }},
      {"units aimed up into the ceiling", [](Json& s) { s["transceivers"]["grids"][0]["axis"] = {0, 0, 1}; }},
      {"a unit aimed into the wall behind it",
       [](Json& s) { unit(s, "wall-west-2")["axis"] = {-0.819, 0, -0.574}; }},
      {"a unit inside a column", [](Json& s) { s["fixtures"].push_back(column("column", 7.2, 2.4)); }},
      {"a unit inside a mesh column", [](Json& s) { s["fixtures"].push_back(mesh_column(7.2, 2.4)); }},
      {"a ceiling unit 1 m above the floor",
       [](Json& s) { unit(s, "over-till")["position"] = {10.6, 2.6, 1.0}; }},
      {"a grid of units at the height of a counter",
       [](Json& s) { s["transceivers"]["grids"][1]["z"] = 0.9; }},
      {"a unit in a closed store room",
       [](Json& s) {
         add_closed_room(s);
         unit(s, "over-till")["position"] = {4.5, 0.5, 3.15};
       }},
      {"a gondola inside another", [](Json& s) { fixture(s, "A2")["at"] = {2.5, 3.3}; }},
      {"a gondola through the wall", [](Json& s) { fixture(s, "A1")["at"] = {-1, 3.1}; }},
      {"a mesh inside a gondola", [](Json& s) { fixture(s, "till")["at"] = {3.5, 3.3, 0}; }},
      {"a gondola through a wall that is a mesh",
       [](Json& s) { s["fixtures"].push_back(mesh_column(6.8, 3.5, 2)); }},
      {"a room of 32 m height", [](Json& s) { s["room"]["size"][2] = 32; }},
      {"a room of 1.9 m height",
       [](Json& s) {
         s["room"]["size"][2] = 1.9;
         for (Json& grid : s["transceivers"]["grids"]) grid["z"] = 1.85;
         for (Json& one : s["transceivers"]["list"]) one["position"][2] = 1.8;
         s["fixtures"].erase(9);
         s["materials"].erase("mirror");
         for (const char* id : {"C1", "T1"}) fixture(s, id)["height"] = 1.85;
       }},
      {"a mesh in millimetres", [](Json& s) { fixture(s, "till")["scale"] = 1000; }},
      {"a mesh a thousand times too small", [](Json& s) { fixture(s, "till")["scale"] = 0.001; }},
      {"a reflectance of 0.99", [](Json& s) { s["materials"]["wall"]["reflectance"] = 0.99; }},
      {"a material that nothing uses",
       [](Json& s) { s["materials"]["wood"] = {{"type", "lambertian"}, {"reflectance", 0.5}}; }},
      {"a label type that nothing uses", [](Json& s) { s["label_types"]["old"] = {{"threshold", 0.01}}; }},
      {"a transceiver type that nothing uses",
       [](Json& s) {
         s["transceiver_types"]["old"] = {{"emission", {{"type", "lambertian"}, {"flux", 1}}}};
       }},
  };
}

std::vector<Mistake> other_mistakes() {
  return {
      {"a safety factor of 0.125 instead of 1.25",
       [](Json& s) { s["label_types"]["shelf"]["safety_factor"] = 0.125; }},
      {"the wavelength of visible light", [](Json& s) { s["wavelength_nm"] = 490; }},
      {"a label of 6 x 3 m", [](Json& s) { s["label_types"]["cooler"]["size"] = {6, 3}; }},
      {"a unit with a radius of 3 m", [](Json& s) { s["transceiver_types"]["spot"]["radius"] = 3; }},
      {"the same candidate twice",
       [](Json& s) {
         s["transceivers"]["list"].push_back(unit(s, "wall-east-1"));
         s["transceivers"]["list"].back()["id"] = "copy";
       }},
      {"a keep-out area in millimetres",
       [](Json& s) { s["transceivers"]["keep_out"][0] = {{"min", {5400, 0}}, {"max", {7800, 1500}}}; }},
      {"labels every 5 mm", [](Json& s) { fixture(s, "A1")["labels"]["spacing"] = 0.005; }},
      {"a label that faces the floor", [](Json& s) { s["labels"][0]["normal"] = {0, 0, -1}; }},
      {"a label just below the ceiling",
       [](Json& s) { s["labels"].push_back(label("high", {0.01, 1.5, 3.1}, {1, 0, 0})); }},
      {"a grid with one candidate per corner of the shop",
       [](Json& s) {
         for (Json& grid : s["transceivers"]["grids"]) grid["spacing"] = 12;
         s["transceivers"]["list"] = {unit(s, "over-till")};
       }},
      {"an aisle of 20 cm", [](Json& s) { fixture(s, "A2")["at"] = {2, 4.2}; }},
      {"units that cost nothing", [](Json& s) { s["transceiver_types"]["spot"]["cost"] = 0; }},
      {"units without a price beside others with one",
       [](Json& s) {
         s["currency"] = "EUR";
         for (Json& type : s["transceiver_types"]) type["cost"] = 25;
         s["transceiver_types"]["spot"].erase("cost");
       }},
      {"reflectances in per cent of per cent",
       [](Json& s) { s["materials"]["wall"]["reflectance"] = 0.008; }},
      {"a counter that floats 1 m above the floor",
       [](Json& s) {
         fixture(s, "coffee")["min"] = {0.1, 8.3, 1.0};
         fixture(s, "coffee")["max"] = {2.8, 8.95, 1.95};
       }},
      {"a cutoff angle in radians",
       [](Json& s) { s["label_types"]["cooler"]["responsivity"]["cutoff_deg"] = 1.309; }},
      {"a rotation in radians", [](Json& s) { fixture(s, "A3")["rotation_deg"] = 1.5708; }},
      {"panes with a thickness in millimetres", [](Json& s) { s["materials"]["door"]["thickness"] = 6; }},
      {"a label listed again, 4 mm beside",
       [](Json& s) { s["labels"].push_back(label("again", {11.598, 1.304, 1.55}, {-1, 0, 0})); }},
  };
}

std::vector<Mistake> plausible_changes() {
  return {
      {"as it is", [](Json&) {}},
      {"walls that join beside a door",
       [](Json& s) {
         const Json door = {{"at", 0.06}, {"width", 0.7}, {"top", 2.1}};
         s["room"]["inner_walls"] = {
             {{"id", "W1"}, {"from", {0.3, 0.5}}, {"to", {1.5, 0.5}}, {"thickness", 0.12}},
             {{"id", "W2"},
              {"from", {1.5, 0.5}},
              {"to", {1.5, 1.5}},
              {"thickness", 0.12},
              {"openings", {door}}}};
       }},
      {"a warehouse ceiling of 9 m",
       [](Json& s) {
         s["room"]["size"][2] = 9;
         fixture(s, "mirror")["at"][2] = 2.75;
       }},
      {"units suspended 60 cm below the ceiling",
       [](Json& s) {
         for (Json& grid : s["transceivers"]["grids"]) grid["z"] = 2.6;
       }},
      {"a low unit on the wall that points into the room",
       [](Json& s) {
         unit(s, "wall-west-1")["position"] = {0.05, 1.2, 1.2};
         unit(s, "wall-west-1")["axis"] = {1, 0, 0};
       }},
      {"a sign with a label on either side",
       [](Json& s) {
         s["labels"].push_back(label("sign-front", {9.0, 0.2, 1.4}, {0, 1, 0}));
         s["labels"].push_back(label("sign-back", {9.0, 0.19, 1.4}, {0, -1, 0}));
         s["fixtures"].push_back(box("sign", {8.9, 0.191, 1.3}, {9.1, 0.199, 1.5}));
       }},
      {"a label on a rail 20 cm in front of the shelf",
       [](Json& s) { s["labels"].push_back(label("rail", {3, 2.9, 1.0}, {0, -1, 0})); }},
      {"columns and walls that meet in corners",
       [](Json& s) {
         s["fixtures"].push_back(box("office west", {8.8, 7.9, 0}, {8.9, 9, 3.2}));
         s["fixtures"].erase(0);  // the coolers, which stand there
         s["fixtures"].push_back(box("office south", {8.8, 7.9, 0}, {10.4, 8.0, 2.4}));
         for (Json& grid : s["transceivers"]["grids"]) grid["max"] = {10.8, 6.0};
         s["materials"].erase("bottles");
         s["label_types"].erase("cooler");
       }},
      {"a column between the aisles", [](Json& s) { s["fixtures"].push_back(mesh_column(7.9, 2.6)); }},
      {"a column in a shelf, as a mesh", [](Json& s) { s["fixtures"].push_back(mesh_column(6.8, 3.5)); }},
      {"a column in a shelf, below a ceiling that is lower than others",
       [](Json& s) {
         s["room"]["zones"] = {
             {{"id", "high"}, {"polygon", {{0, 0}, {2, 0}, {2, 1}, {0, 1}}}, {"height", 5}}};
         s["fixtures"].push_back(column("column", 6.8, 3.5));
       }},
      {"a column in a wall",
       [](Json& s) {
         s["fixtures"].push_back(box("partition", {10.22, 6.05, 0}, {10.32, 7.55, 3.2}));
         s["fixtures"].push_back(box("column", {10.24, 6.4, 0}, {10.32, 6.6, 3.2}));
       }},
      {"a stronger unit", [](Json& s) { s["transceiver_types"]["ring"]["emission"]["flux"] = 3; }},
      {"less sensitive labels", [](Json& s) { s["label_types"]["shelf"]["threshold"]["at_m"] = 4; }},
      {"two prices", [](Json& s) { s["transceiver_types"]["spot"]["cost"] = 25.5; }},
      {"two units at one point with different axes",
       [](Json& s) {
         s["transceivers"]["list"].push_back(unit(s, "wall-east-1"));
         s["transceivers"]["list"].back()["id"] = "other axis";
         s["transceivers"]["list"].back()["axis"] = {-0.7, 0.3, -0.574};
       }},
  };
}

}  // namespace shelfbeam::test
