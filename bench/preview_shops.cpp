#include "preview_shops.hpp"

#include <string>
#include <utility>

#include "unit/transport/zoo.hpp"

namespace shelfbeam::bench {

namespace {

using test::ZooStore;

// Labels on a plane x = `at`, which face +x or -x.
void labels_across(ZooStore& store, double at, double facing, double from, double to, int count) {
  for (int k = 0; k < count; ++k)
    store.label({at + 0.01 * facing, from + (to - from) * (k + 0.5) / count, 0.25 + 0.45 * (k % 4)},
                {facing, 0, 0});
}

// A room with a box four metres long in front of the wall at x = 8, and labels on both of its long sides and
// on the opposite wall.
ZooStore beside_wall(double reflectance, double gap, double depth) {
  ZooStore store = ZooStore(8, 6, 2.7, reflectance).paint("floor", 0.3).cover("floor", "floor");
  const double back = 8 - gap, front = back - depth;
  store.box({front, 1, 0}, {back, 5, 2}, "walls");
  labels_across(store, back, 1, 1.1, 4.9, 24);
  labels_across(store, front, -1, 1.1, 4.9, 8);
  labels_across(store, 0, 1, 0.5, 5.5, 8);
  return store.grid(3, 2, 2.65);
}

ZooStore dark() {
  ZooStore store = ZooStore(8, 6, 2.7, 0.15).requirement(0.01).paint("goods", 0.3);
  for (const double y : {1.4, 3.6})
    store.shelves(1.2, y, 5, 1.6, {0.1, 0.6, 1.1}, 0.8, "walls", {{"goods", "goods"}});
  return store.grid(3, 2, 2.65);
}

ZooStore columns() {
  ZooStore store = ZooStore(8, 6, 2.7, 0.7)
                       .paint("goods", 0.5)
                       .shelves(1, 4.4, 5.5, 1.6, {0.1, 0.6, 1.1}, 1.1, "walls", {{"goods", "goods"}});
  for (const double x : {1.7, 3.9, 6.1}) {
    store.box({x, 2, 0}, {x + 0.4, 2.4, 2.7}, "walls");
    store.box({x + 0.3, 0.6, 0}, {x + 0.5, 0.8, 2.7}, "walls");
    labels_across(store, x + 0.4, 1, 2, 2.4, 3);
    labels_across(store, x, -1, 2, 2.4, 3);
  }
  return store.grid(3, 2, 2.65);
}

ZooStore turned_shelves() {
  ZooStore store = ZooStore(8, 6, 2.7, 0.7).paint("goods", 0.5);
  for (const double x : {1.5, 4.5})
    store.shelves(x, 1.5, 3, 1.7, {0.1, 0.6, 1.1}, 0.6, "walls", {{"goods", "goods"}, {"rotation_deg", 33}});
  return store.grid(3, 2, 2.65);
}

}  // namespace

std::vector<PreviewShop> preview_shops() {
  std::vector<PreviewShop> shops;
  const auto add = [&](std::string_view name, const ZooStore& store) {
    shops.push_back({name, make_scene(parse_store(store.text(), std::string(name), "."))});
  };
  add("white, 0.8, behind a box", beside_wall(0.8, 0.8, 0.5));
  add("white, 0.92, behind a box", beside_wall(0.92, 0.8, 0.5));
  add("dark", dark());
  add("strip of 5 cm", beside_wall(0.7, 0.05, 0.6));
  add("strip of 10 cm", beside_wall(0.7, 0.1, 0.6));
  add("strip of 60 cm", beside_wall(0.7, 0.6, 0.6));
  add("columns", columns());
  add("shelves turned round", turned_shelves());
  return shops;
}

}  // namespace shelfbeam::bench
