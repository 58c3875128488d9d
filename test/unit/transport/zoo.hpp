#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/transport/world/path_rules.hpp"

namespace shelfbeam::test {

/// A small room for tests of standard errors.
struct ZooRoom {
  std::string name;
  std::string store;                   ///< text of a store file
  Strategy reference = Strategy::nee;  ///< strategy of the uniform estimator that converges best there
  double reflectance = 0;              ///< largest reflectance
  std::uint32_t effort = 4;            ///< walks or particles of the reference, relative to other rooms
  std::string folder = ".";            ///< of the files that the store names

  Scene scene() const { return make_scene(parse_store(store, name, folder)); }
};

/// Builds a store file.
class ZooStore {
 public:
  using Json = nlohmann::json;

  ZooStore(double x, double y, double z, double reflectance) : size_{x, y, z} {
    material("walls", {{"type", "lambertian"}, {"reflectance", reflectance}});
    store_["room"] = {{"size", {x, y, z}}, {"floor", "walls"}, {"ceiling", "walls"}, {"walls", "walls"}};
    store_["label_types"]["point"] = {{"threshold", 0.02}};
    unit_type("wide", {{"type", "sin2theta"}, {"peak", 1}});
  }

  ZooStore& material(const std::string& name, const Json& of) {
    store_["materials"][name] = of;
    return *this;
  }
  ZooStore& paint(const std::string& name, double reflectance) {
    return material(name, {{"type", "lambertian"}, {"reflectance", reflectance}});
  }
  /// `surface`: floor, ceiling or walls.
  ZooStore& cover(const std::string& surface, const std::string& with) {
    store_["room"][surface] = with;
    return *this;
  }
  ZooStore& requirement(double threshold) {
    for (auto& type : store_["label_types"]) type["threshold"] = threshold;
    return *this;
  }
  ZooStore& label_size(double width, double height) {
    store_["label_types"]["point"]["size"] = {width, height};
    return *this;
  }
  ZooStore& unit_type(const std::string& name, const Json& emission, double radius = 0) {
    store_["transceiver_types"][name] = {{"emission", emission}};
    if (radius > 0) store_["transceiver_types"][name]["radius"] = radius;
    return *this;
  }
  ZooStore& box(std::initializer_list<double> low, std::initializer_list<double> high,
                const std::string& material) {
    store_["fixtures"].push_back({{"type", "box"},
                                  {"id", fmt::format("box{}", store_["fixtures"].size())},
                                  {"min", low},
                                  {"max", high},
                                  {"material", material}});
    return *this;
  }
  /// A wall across the room, with a door 0.9 m wide `at` metres from its beginning.
  ZooStore& inner_wall(std::initializer_list<double> from, std::initializer_list<double> to, double at) {
    Json wall = plain_wall(from, to);
    wall["openings"] = {{{"at", at}, {"width", 0.9}, {"top", 2.1}}};
    store_["room"]["inner_walls"].push_back(wall);
    return *this;
  }
  ZooStore& inner_wall(std::initializer_list<double> from, std::initializer_list<double> to) {
    store_["room"]["inner_walls"].push_back(plain_wall(from, to));
    return *this;
  }
  /// Shelving along x, with a label every `spacing` metres.
  ZooStore& shelves(double x, double y, double length, double height, std::initializer_list<double> boards,
                    double spacing, const std::string& material = "walls", const Json& more = {}) {
    Json gondola{{"type", "gondola"},
                 {"id", fmt::format("G{}", store_["fixtures"].size())},
                 {"at", {x, y}},
                 {"length", length},
                 {"depth", 0.8},
                 {"height", height},
                 {"shelves", boards},
                 {"material", material},
                 {"labels", {{"type", "point"}, {"spacing", spacing}}}};
    if (more.is_object()) gondola.update(more);
    store_["fixtures"].push_back(gondola);
    return *this;
  }
  ZooStore& label(std::initializer_list<double> at, std::initializer_list<double> normal) {
    store_["labels"].push_back({{"id", fmt::format("L{}", store_["labels"].size())},
                                {"position", at},
                                {"normal", normal},
                                {"type", "point"}});
    return *this;
  }
  ZooStore& unit(std::initializer_list<double> at, std::initializer_list<double> axis = {0, 0, -1},
                 const std::string& type = "wide") {
    Json& list = store_["transceivers"]["list"];
    list.push_back(
        {{"id", fmt::format("U{}", list.size())}, {"position", at}, {"axis", axis}, {"type", type}});
    return *this;
  }
  /// A grid of units at a height, facing down.
  ZooStore& grid(int nx, int ny, double z, const std::string& type = "wide") {
    for (int i = 0; i < nx; ++i)
      for (int j = 0; j < ny; ++j)
        unit({size_[0] * (i + 0.5) / nx, size_[1] * (j + 0.5) / ny, z}, {0, 0, -1}, type);
    return *this;
  }

  std::string text() const { return store_.dump(); }

 private:
  Json plain_wall(std::initializer_list<double> from, std::initializer_list<double> to) const {
    const std::size_t before = store_["room"].value("inner_walls", Json::array()).size();
    return {{"id", fmt::format("wall{}", before)}, {"from", from}, {"to", to}};
  }

  double size_[3];
  Json store_;
};

/// Rooms that span the range of stores: ceilings from 2.2 to 12 m, labels and units from a centimetre to a
/// metre off a surface, all materials, points and discs, reflectances from 0.02 to 0.99, a corridor, a hall
/// of 500 m, a box of half a metre, back rooms and columns.
inline std::vector<ZooRoom> zoo() {
  using Value = ZooStore::Json;
  std::vector<ZooRoom> rooms;
  const auto add = [&](const std::string& name, double reflectance, const ZooStore& store,
                       Strategy reference = Strategy::nee, std::uint32_t effort = 4) {
    rooms.push_back({name, store.text(), reference, reflectance, effort});
  };
  const Value steel{{"type", "conductor"}, {"eta", 1.674}, {"k", 8.608}};
  const auto rough = [](Value material, const Value& roughness) {
    material["roughness"] = roughness;
    return material;
  };
  const Value coat{{"type", "plastic"}, {"ior", 1.5}, {"reflectance", 0.5}};
  const Value pane{
      {"type", "thin_dielectric"}, {"ior", 1.515}, {"thickness", 0.006}, {"absorption_per_m", 20}};
  const Value goods{{"goods", "goods"}};
  const auto shop = [&](double height, double reflectance) {
    return ZooStore(6, 5, height, reflectance)
        .paint("goods", 0.5)
        .shelves(0.8, 1.6, 4, std::min(1.8, height - 0.4), {0.1, 0.6, 1.2}, 1.3, "walls", goods);
  };

  add("low shop", 0.7,
      ZooStore(6, 5, 2.2, 0.7)
          .paint("goods", 0.5)
          .shelves(0.8, 1.2, 4, 1.5, {0.05, 0.3, 1}, 1.3, "walls", goods)
          .shelves(1, 3.4, 3.5, 1.5, {0.1, 0.5}, 1.7, "walls", goods)
          .grid(3, 2, 2.1)
          .grid(2, 1, 1.95));
  add("ordinary shop", 0.8, shop(3, 0.8).grid(3, 2, 2.9).grid(2, 2, 2.5));
  add("high shop", 0.6, shop(6, 0.6).requirement(0.01).grid(3, 2, 5.9).grid(2, 2, 5));
  add("warehouse", 0.4,
      ZooStore(20, 14, 12, 0.4)
          .requirement(0.004)
          .paint("goods", 0.5)
          .shelves(3, 4, 12, 2.6, {0.1, 1, 2.2}, 4, "walls", goods)
          .shelves(3, 9, 12, 2.6, {0.1, 1, 2.2}, 4, "walls", goods)
          .grid(4, 3, 11.5));
  const auto floor_labels = [](ZooStore store, double x) {
    int k = 0;
    for (const double z : {0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0}) {
      const double y = 1.8 + 0.25 * k++;
      store.label({x, y, z}, {1, 0, 0}).label({x, y, z}, {1, 0, -1});
    }
    return store;
  };
  const auto in_3_m = [&](double reflectance) { return ZooStore(6, 6, 3, reflectance); };
  add("labels above the floor", 0.5,
      floor_labels(in_3_m(0.5), 2).grid(2, 2, 2.95).unit({3, 3, 2.5}).unit({3.1, 2.2, 1.2}), Strategy::nee,
      32);
  {
    ZooStore dark = in_3_m(0.1).requirement(0.01);
    for (const double off : {0.01, 0.04, 0.1, 0.3, 1.0})
      dark.label({off, 3, 1.2}, {-1, 0, 0})
          .label({off, 2, 0.6}, {1, 0, 0})
          .label({off, off, 1}, {0, 1, 0})
          .label({3, 6 - off, 0.2}, {0, 0, 1});
    add("dark room", 0.1, dark.grid(2, 2, 2.95).unit({3.2, 2, 2.96}, {1, 0, -0.2}), Strategy::nee, 32);
  }
  const auto wall_units = [](ZooStore store) {
    for (const double off : {0.02, 0.05, 0.1, 0.3, 1.0})
      store.unit({off, 3, 2.5})
          .unit({3, off, 2.3}, {0, 1, -0.6})
          .unit({off + 2, 3.5, 3 - off}, {0.7, 0, 0.3});
    return store;
  };
  add("units beside surfaces", 0.6, wall_units(shop(3, 0.6)), Strategy::particle);
  add("units beside dark surfaces", 0.2, wall_units(shop(3, 0.2).requirement(0.01)), Strategy::particle);
  {
    ZooStore both = in_3_m(0.6);
    for (const double off : {0.05, 0.15, 0.4}) {
      both.label({off, 2, 2}, {1, 0, 0}).label({off, 2.5, 1}, {0, 1, 0}).label({off, 4, 0.1}, {1, 0, -1});
      both.unit({off, 3, 2.4}, {1, 0, -1}).unit({off, 3.5, 2.9}).unit({off + 1, 2.2, 2.9}, {-1, 0, 0.2});
    }
    add("labels and units at one wall", 0.6, both, Strategy::mis, 32);
  }
  add("discs", 0.7,
      shop(3, 0.7)
          .unit_type("small", {{"type", "sin2theta"}, {"peak", 1}}, 0.03)
          .unit_type("panel", {{"type", "lambertian"}, {"flux", 3}}, 0.2)
          .grid(2, 2, 2.9, "small")
          .grid(2, 1, 2.8, "panel"));
  const auto with_discs = [](ZooStore store) {
    return store.unit_type("small", {{"type", "sin2theta"}, {"peak", 1}}, 0.05).grid(3, 2, 2.7, "small");
  };
  add("mirror floor, discs", 0.7,
      with_discs(shop(3, 0.7).material("mirror", steel).cover("floor", "mirror").grid(2, 1, 2.5)));
  add("polished floor", 0.7,
      with_discs(shop(3, 0.7).material("polished", coat).cover("floor", "polished").grid(3, 2, 2.9)));
  add("floor of a rough coat", 0.7,
      shop(3, 0.7)
          .material("lino", rough(coat, 0.15))
          .cover("floor", "lino")
          .grid(3, 2, 2.9)
          .grid(2, 1, 2.5));
  add("cabinets of rough metal", 0.7,
      shop(3, 0.7)
          .material("metal", rough(steel, 0.2))
          .box({0.5, 3.6, 0}, {5.5, 4.2, 1.9}, "metal")
          .cover("ceiling", "metal")
          .grid(3, 2, 2.8));
  add("brushed metal", 0.7,
      shop(3, 0.7)
          .material("brushed", rough(steel, {0.1, 0.3}))
          .box({0.5, 3.6, 0}, {5.5, 4.2, 1.9}, "brushed")
          .grid(3, 2, 2.8));
  add("glass doors", 0.7,
      ZooStore(6, 5, 3, 0.7)
          .material("door", pane)
          .paint("goods", 0.5)
          .shelves(0.8, 2, 4, 1.9, {0.15, 0.6, 1.2}, 1.3, "walls", {{"doors", "door"}, {"goods", "goods"}})
          .grid(3, 2, 2.9));
  add("mirrors and panes, discs", 0.6,
      with_discs(shop(3, 0.6)
                     .material("mirror", {{"type", "conductor"}, {"eta", 0}, {"k", 1}})
                     .material("door", pane)
                     .box({0.1, 4.9, 0.5}, {5.9, 4.95, 2.2}, "mirror")
                     .box({1, 3.5, 0.5}, {3, 3.55, 2}, "door")));
  add("blocks of glass", 0.7,
      shop(3, 0.7)
          .unit_type("panel", {{"type", "lambertian"}, {"flux", 3}}, 0.2)
          .material("clear", {{"type", "dielectric"}, {"ior", 1.5}})
          .material("frosted", rough({{"type", "dielectric"}, {"ior", 1.5}}, 0.3))
          .box({0.6, 3.4, 0}, {1.6, 3.9, 1.5}, "clear")
          .box({3, 3.4, 0}, {4.5, 3.9, 1.5}, "frosted")
          .grid(2, 2, 2.9)
          .grid(2, 1, 2.7, "panel"),
      Strategy::mis);
  {
    const auto beckmann = [&](Value material, double roughness) {
      material["distribution"] = "beckmann";
      return rough(material, roughness);
    };
    add("Beckmann facets", 0.7,
        shop(3, 0.7)
            .material("lino", beckmann(coat, 0.2))
            .material("sheet", beckmann(steel, 0.1))
            .cover("floor", "lino")
            .box({0.5, 3.6, 0}, {5.5, 4.2, 1.9}, "sheet")
            .grid(3, 2, 2.8));
  }
  const auto white = [&](double reflectance) {
    ZooStore store = ZooStore(4, 5, 3, reflectance).requirement(0.2);
    for (int k = 0; k < 8; ++k)
      store.label({0.5 + 0.4 * k, 1 + 0.3 * k, 0.1 + 0.3 * k}, {k % 3 - 1.0, k % 2 - 0.5, 0.2 * (k % 4)});
    return store.unit({1.3, 2.2, 1.5}).unit({3, 3, 2.9}).unit({2, 4, 2.5}, {0, -1, 0});
  };
  add("white room, 0.9", 0.9, white(0.9));
  add("white room, 0.97", 0.97, white(0.97));
  add("white room, 0.99", 0.99, white(0.99));
  add("black room", 0.02, floor_labels(in_3_m(0.02).requirement(0.005), 2).grid(3, 2, 2.95));
  {
    ZooStore corridor(40, 2, 2.6, 0.6);
    for (int k = 0; k < 10; ++k)
      corridor.label({2 + 4.0 * k, 0.01, 0.3 + 0.15 * k}, {0, 1, 0})
          .label({1 + 4.0 * k, 1.99, 0.1}, {0, -1, 0});
    add("corridor", 0.6, corridor.grid(10, 1, 2.5));
  }
  {
    ZooStore hall(500, 500, 8, 0.5);
    hall.requirement(0.004).paint("goods", 0.5);
    for (int k = 0; k < 3; ++k)
      hall.shelves(100.0 + 120 * k, 245.0 + k, 6, 1.8, {0.1, 1}, 2, "goods")
          .unit({103.0 + 120 * k, 243, 7.5})
          .unit({101.0 + 120 * k, 249, 6})
          .unit({108.0 + 120 * k, 240, 7.9})
          .unit({130.0 + 120 * k, 250, 7.9});
    add("hall of 500 m", 0.5, hall);
  }
  {
    ZooStore small = ZooStore(0.5, 0.4, 0.3, 0.5).requirement(2);
    for (int k = 0; k < 6; ++k) small.label({0.05 + 0.07 * k, 0.1, 0.005 + 0.03 * k}, {0, 1, -0.5 * (k % 2)});
    add("box of half a metre", 0.5, small.grid(2, 2, 0.29));
  }
  add("labels with a size", 0.7, shop(3, 0.7).label_size(0.2, 0.1).grid(3, 2, 2.9).unit({2, 1.5, 1.9}));
  add("narrow beams", 0.6,
      shop(3, 0.6)
          .unit_type("beam", {{"type", "lambertian"}, {"flux", 1}, {"order", 20}})
          .unit_type("ring", {{"type", "table"}, {"theta_deg", {20, 45, 70}}, {"intensity", {0, 1, 0}}})
          .grid(3, 2, 2.9, "beam")
          .grid(2, 2, 2.9, "ring")
          .unit({0.2, 2, 2.8}, {0.3, 0.2, -1}, "beam"));
  const auto wall_labels = [](ZooStore store, double y, int count) {
    for (int k = 0; k < count; ++k)
      store.label({0.01, 0.8 + 0.8 * k, 0.3 + 0.5 * (k % 3)}, {1, 0, 0})
          .label({0.8 + 1.1 * k, y - 0.01, 0.3 + 0.5 * (k % 3)}, {0, -1, 0});
    return store;
  };
  const auto back_room = [&] {
    return ZooStore(12, 9, 3.2, 0.75)
        .inner_wall({9, 6}, {12, 6}, 0.4)
        .inner_wall({9, 6}, {9, 9})
        .unit({11, 7.8, 3.1})
        .unit({10, 7, 2.4})
        .unit({3, 3, 3.1})
        .unit({8, 6, 3.1});
  };
  add("back room", 0.75, wall_labels(back_room(), 9, 7), Strategy::particle);
  add("back room with labels", 0.75,
      wall_labels(back_room(), 9, 7).label({11.99, 8, 1}, {-1, 0, 0}).label({10.5, 8.99, 0.4}, {0, -1, 0}),
      Strategy::particle);
  add("rooms in a row", 0.6,
      wall_labels(ZooStore(9, 6, 3, 0.6)
                      .requirement(0.01)
                      .paint("goods", 0.5)
                      .inner_wall({5, 0}, {5, 6}, 2.5)
                      .inner_wall({7, 0}, {7, 6}, 0.5)
                      .box({2, 2, 0}, {4.4, 2.8, 1.6}, "goods")
                      .unit({6, 3.5, 2.9})
                      .unit({8, 3, 2.9})
                      .unit({2.5, 4, 2.9}),
                  6, 4),
      Strategy::particle);
  {
    ZooStore columns = ZooStore(8, 6, 3.4, 0.75).box({4, 3, 0}, {4.4, 3.4, 3.4}, "walls");
    columns.box({2, 1.5, 0}, {2.3, 1.8, 3.4}, "walls");
    for (const double off : {0.1, 0.15, 0.3})
      columns.unit({4 - off, 3.15, 3.38}).unit({4.2, 3.4 + off, 3.35}).unit({2.3 + off, 1.6, 3.3});
    add("units beside columns", 0.75, wall_labels(columns.unit({6, 2, 3.38}), 6, 6), Strategy::particle);
  }
  return rooms;
}

inline ZooRoom zoo_room(const std::string& name) {
  const std::vector<ZooRoom> rooms = zoo();
  return *std::find_if(rooms.begin(), rooms.end(), [&](const ZooRoom& room) { return room.name == name; });
}

}  // namespace shelfbeam::test
