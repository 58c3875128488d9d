#pragma once

#include "unit/report/supermarket_report.hpp"

namespace shelfbeam::test {

// A shop with a slanted wall from (8, 0) to (12, 4), a shaft and a bakery with a lower ceiling. The inner
// wall W1 has a door and a window with a pane; W2 is joined to it, ends at the slanted wall and is 1 m high.
inline Store corner_shop_store() {
  Store store = sample_store::empty_store("Corner shop", {12, 10, 3.2});
  Room& room = *store.room;
  room.shape.is_box = false;
  room.shape.outline = {{0, 0}, {8, 0}, {12, 4}, {12, 10}, {0, 10}};
  room.shape.holes = {{{8, 6}, {9, 6}, {9, 7}, {8, 7}}};
  room.shape.zones = {{"bakery", {{0, 6}, {4, 6}, {4, 10}, {0, 10}}, {2.6, {}}}};
  room.shape.inner_walls = {
      {"W1", {6, 0}, {6, 3}, 0.2, {}, {{0.5, 0.9, 0, 2.1, false}, {1.8, 0.8, 0.9, 2, true}}},
      {"W2", {6, 3}, {11, 3}, 0.2, 1.0, {}}};
  store.materials.push_back({"glass", ThinDielectric{}});
  const MaterialId grey{0}, glass{1};
  room.walls.assign(5, grey);
  room.zones = {{grey, grey}};
  room.inner_walls = {{grey, {std::nullopt, glass}}, {grey, {}}};
  const auto add = [&](Fixture fixture) { store.fixtures.push_back({std::move(fixture), "fixtures"}); };
  add(sample_store::gondola("row", {5, 5}, 3, 0.8, {0.5, 1.2}, 30, {Face::front, Face::back}));
  add(Prism{"counter", {{1, 7}, {3.5, 7}, {3.5, 9.5}, {3, 9.5}, {3, 7.5}, {1, 7.5}}, {0, 1.1}, grey});
  add(Cylinder{"column", {10, 8}, 0.3, {}, grey});
  add(Panel{"screen", {Vec3{1, 4, 0}, {2, 5, 0}, {2, 5, 1.8}}, grey});
  sample_store::add_devices(store, {11.9, 6, 1}, {7.5, 8, 3.1});
  return store;
}

struct CornerShop {
  Scene scene = make_scene(corner_shop_store());
  SignalMatrix matrix = sample_store::matrix_of(scene);
  CertifiedPlan plan{sample_store::cover(matrix)};
  ReportInput input{scene, matrix, plan};
};

}  // namespace shelfbeam::test
