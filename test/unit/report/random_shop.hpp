#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "shelfbeam/math/polygon.hpp"

#include "unit/report/sample_store.hpp"

namespace shelfbeam::test {

/// Shops with walls, zones, fixtures and units at random.
class RandomShop {
 public:
  explicit RandomShop(unsigned seed) : random_(seed) {}

  Store store() {
    const double width = between(14, 40), depth = between(12, 60), height = between(3.4, 7);
    Store store = sample_store::empty_store("Random", {width, depth, height});
    shape_room(store, width, depth);
    add_fixtures(store, width, depth);
    store.labels.push_back({Label{"L", {0.3, 5.5, 1}, {1, 0, 0}, LabelTypeId{0}}, "labels[0]"});
    add_units(store, width, depth);
    return store;
  }

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  bool one_of(int count) { return std::uniform_int_distribution<int>(1, count)(random_) == 1; }

 private:
  void shape_room(Store& store, double width, double depth) {
    RoomShape& shape = store.room->shape;
    const double part = between(3, 5);
    switch (std::uniform_int_distribution<int>(0, 4)(random_)) {
      case 0:
        break;
      case 1:  // an L
        set_outline(store, {{0, 0},
                            {width, 0},
                            {width, depth - part},
                            {width - part, depth - part},
                            {width - part, depth},
                            {0, depth}});
        break;
      case 2:  // a corner cut at any angle
        set_outline(store,
                    {{0, 0}, {width, 0}, {width, depth - part}, {width - between(2, 6), depth}, {0, depth}});
        break;
      case 3:  // a slanted wall
        set_outline(store, {{0, 0}, {width, 0}, {width, depth - part}, {0, depth}});
        break;
      default:  // a shaft
        shape.is_box = false;
        set_outline(store, shape.outline);
        shape.holes = {{{11, 6}, {12.5, 6}, {12.5, 7}, {11, 7}}};
    }
    if (one_of(2)) {
      shape.zones = {{"zone-1", {{0, 0}, {5, 0}, {5, 5}, {0, 5}}, {between(2.4, 3), {}}}};
      store.room->zones = {{MaterialId{0}, MaterialId{0}}};
    }
    if (one_of(2)) {
      shape.inner_walls = {{"W1", {8, 0}, {8, between(2, 6)}, 0.2, {}, {}}};
      if (one_of(2)) shape.inner_walls[0].height = 2.2;
      store.room->inner_walls = {{MaterialId{0}, {}}};
    }
  }

  static void set_outline(Store& store, Polygon outline) {
    store.room->shape.is_box = false;
    store.room->walls.assign(outline.size(), MaterialId{0});
    store.room->shape.outline = std::move(outline);
  }

  // Whether a square about a point is free of walls.
  static bool is_free(const RoomShape& shape, const Vec2& at, double half) {
    for (const double x : {at[0] - half, at[0], at[0] + half})
      for (const double y : {at[1] - half, at[1], at[1] + half}) {
        if (!shape.covers({x, y})) return false;
        for (const InnerWall& wall : shape.inner_walls)
          if (distance_to_border(wall.footprint(0, wall.length()), {x, y}) < half / 2 + 0.2) return false;
      }
    return true;
  }

  void add_fixtures(Store& store, double width, double depth) {
    int number = 0;
    for (int column = 0; 3 + 4 * column < width; ++column)
      for (int row = 0; 3 + 4 * row < depth; ++row) {
        const double x = 3 + 4 * column, y = 3 + 4 * row;
        if (one_of(4) || !is_free(store.room->shape, {x, y}, 1.8)) continue;
        const std::string id = "F" + std::to_string(++number);
        store.fixtures.push_back({fixture(id, {x, y}), "fixtures"});
      }
  }

  Fixture fixture(const std::string& id, const Vec2& at) {
    const double high = between(0.8, 2.3), a = between(0.3, 1), b = between(0.3, 1);
    switch (std::uniform_int_distribution<int>(0, 4)(random_)) {
      case 0:
        return Box{id, {at[0] - a, at[1] - b, 0}, {at[0] + a, at[1] + b, high}, {}};
      case 1:
        return Cylinder{id, at, a / 2, {}, MaterialId{0}};
      case 2:
        return Prism{id,
                     {{at[0] - a, at[1] - b},
                      {at[0] + a, at[1] - b},
                      {at[0] + a, at[1]},
                      {at[0], at[1]},
                      {at[0], at[1] + b},
                      {at[0] - a, at[1] + b}},
                     {0, high},
                     MaterialId{0}};
      default: {
        constexpr double length = 2.4, width = 0.8;
        const double turns[] = {0, 90, between(0, 180)};
        const double turn = turns[std::uniform_int_distribution<int>(0, 2)(random_)];
        const double c = std::cos(turn * std::numbers::pi / 180), s = std::sin(turn * std::numbers::pi / 180);
        const Vec2 corner{at[0] - c * length / 2 + s * width / 2, at[1] - s * length / 2 - c * width / 2};
        return sample_store::gondola(id, corner, length, width, {0.4, high / 2 + 0.3, high}, turn,
                                     {Face::front, Face::back});
      }
    }
  }

  void add_units(Store& store, double width, double depth) {
    const Scene empty = make_scene_without_units(store);
    constexpr std::size_t count = 8;
    while (store.transceivers.size() < count) {
      const Vec2 plan{between(0.2, width - 0.2), between(0.2, depth - 0.2)};
      if (!is_free(store.room->shape, plan, 0.2)) continue;
      const double ceiling = store.room->shape.ceiling_over(plan).at(plan);
      const double z = one_of(4) ? between(1.2, ceiling - 0.1) : ceiling - between(0.05, 0.3);
      const bool is_blocked =
          std::any_of(empty.fixtures.begin(), empty.fixtures.end(), [&](const FixtureOutline& fixture) {
            return z < fixture.height + 0.05 &&
                   (contains(fixture.footprint, plan) || distance_to_border(fixture.footprint, plan) < 0.05);
          });
      if (is_blocked) continue;
      Transceiver unit;
      unit.id = "T" + std::to_string(store.transceivers.size() + 1);
      unit.position = {plan[0], plan[1], z};
      unit.type = TransceiverTypeId{0};
      store.transceivers.push_back({unit, "transceivers.list"});
    }
  }

  static Scene make_scene_without_units(Store store) {
    Transceiver unit;
    unit.id = "T";
    unit.position = {0.3, 5.5, 2};
    unit.type = TransceiverTypeId{0};
    store.transceivers.push_back({unit, "transceivers.list"});
    return make_scene(store);
  }

  std::mt19937_64 random_;
};

}  // namespace shelfbeam::test
