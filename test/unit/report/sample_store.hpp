#pragma once

#include "shelfbeam/math/random.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

#include "support/testing.hpp"

// A store with a signal matrix computed from distance, angle and line of sight: realistic, and known without
// a simulation.
namespace shelfbeam::sample_store {

inline Gondola gondola(const std::string& id, Vec2 at, double length, double depth,
                       std::vector<double> shelves, double rotation_deg, std::vector<Face> faces) {
  Gondola g;
  g.id = id;
  g.at = at;
  g.rotation_deg = rotation_deg;
  g.length = length;
  g.depth = depth;
  g.height = shelves.back() + 0.4;
  g.shelves = std::move(shelves);
  g.faces = faces;
  FixtureLabels& labels = g.labels.emplace();
  labels.spacing = 0.6;
  labels.faces = std::move(faces);
  return g;
}

inline Store empty_store(const std::string& name, const Vec3& size) {
  Store store;
  store.file = "sample.json";
  store.name = name;
  store.room = Room::box(size, {});
  store.materials = {{"grey", Lambertian{0.7}}};
  store.label_types = {{"standard", CosineResponse{}, {}, 0.012, 1, 0, 0},
                       {"large", CosineResponse{}, {}, 0.009, 1.1, 0, 0}};
  store.transceiver_types = {{"ceiling", SinTwoTheta{1}, 0, 1}};
  return store;
}

inline void add(Store& store, Fixture fixture) {
  store.fixtures.push_back({std::move(fixture), "fixtures"});
}
inline void add_label(Store& store, const std::string& id, const Vec3& position,
                      const Vec3& normal = {0, -1, 0}) {
  store.labels.push_back({Label{id, position, normal, LabelTypeId{0}}, "labels"});
}
inline void add_unit(Store& store, const std::string& id, const Vec3& position, const Vec3& axis = {0, 0, -1},
                     double roll_deg = 0) {
  store.transceivers.push_back({Transceiver{id, position, axis, roll_deg, {}, false}, "transceivers.list"});
}

/// A label and a unit, which every scene has.
inline void add_devices(Store& store, const Vec3& label, const Vec3& unit) {
  add_label(store, "L", label);
  add_unit(store, "T", unit);
}

/// A wall or block of triangles.
inline MeshFixture mesh(const std::string& id, std::vector<Vec3> vertices,
                        std::vector<std::array<std::uint32_t, 3>> triangles) {
  return {id, {}, 0, 1, {{"m", {}, std::move(vertices), std::move(triangles)}}};
}

/// About 25 x 18 m, 800 labels, 300 candidates.
inline Store supermarket() {
  Store store = empty_store("Corner grocery", {25, 18, 4});
  const std::vector<double> shelves{0.4, 0.85, 1.3, 1.7};
  for (int aisle = 0; aisle < 4; ++aisle)
    for (int run = 0; run < 2; ++run)
      add(store, gondola("A" + std::to_string(2 * aisle + run + 1), {4.0 + 8.2 * run, 3.2 + 2.6 * aisle}, 6.8,
                         0.9, shelves, 0, {Face::front, Face::back}));
  add(store, gondola("W1", {1.0, 17.5}, 16, 0.45, shelves, 0, {Face::front}));
  add(store, gondola("W2", {24.5, 3.0}, 11, 0.45, {0.3, 0.7, 1.1, 1.5, 1.9}, 90, {Face::back}));
  Freezer freezer;
  freezer.id = "F1";
  freezer.at = {4, 13.8};
  freezer.length = 10;
  freezer.depth = 1.1;
  freezer.height = 0.9;
  FixtureLabels& labels = freezer.labels.emplace();
  labels.type = LabelTypeId{1};
  labels.spacing = 0.7;
  labels.faces = {Face::front, Face::back};
  add(store, freezer);
  for (int column = 0; column < 3; ++column)
    add(store,
        Box{"P" + std::to_string(column + 1), {6.0 + 6 * column, 1.3, 0}, {6.35 + 6 * column, 1.65, 4}, {}});
  store.grids = {{{{1, 1}, {24, 17}, 2, 3.9, {0, 0, -1}, 0, {}}, "store.json: transceivers.grids[0]"}};
  return store;
}

/// One gondola and two units: few enough to check by hand; ids that need escaping.
inline Store kiosk() {
  Store store = empty_store("Joe's <Kiosk> & \"Bar\"", {6, 5, 3});
  add(store, gondola("A<1>", {1.5, 2}, 3, 0.8, {0.5, 1.2}, 0, {Face::front, Face::back}));
  add_unit(store, "T&1", {1.5, 1, 2.9}, {0, 0, -1}, 30);
  add_unit(store, "T,2", {4.5, 4, 2.9});
  add_unit(store, "T\"3\"", {3, 1, 2.9});
  store.installed.push_back({"T,2", "installed"});
  return store;
}

/// An upright box over the bounding rectangle of a fixture.
struct Block {
  explicit Block(const FixtureOutline& fixture) : high{-1e9, -1e9, fixture.height} {
    for (const auto& [x, y] : fixture.footprint) {
      low = {std::min(low.x, x), std::min(low.y, y), 0};
      high = {std::max(high.x, x), std::max(high.y, y), fixture.height};
    }
  }
  Vec3 low{1e9, 1e9, 0}, high;
};

// Whether the segment from a to b passes through it.
inline bool blocks(const Block& block, const Vec3& a, const Vec3& b) {
  const auto& [low, high] = block;
  double enter = 0, leave = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = b[axis] - a[axis];
    if (std::abs(d) < 1e-12) {
      if (a[axis] < low[axis] || a[axis] > high[axis]) return false;
      continue;
    }
    const double s = (low[axis] - a[axis]) / d, t = (high[axis] - a[axis]) / d;
    enter = std::max(enter, std::min(s, t));
    leave = std::min(leave, std::max(s, t));
  }
  return enter < leave;
}

/// Labels and transceivers without signals.
inline SignalMatrix rows_and_columns_of(const Scene& scene) {
  SignalMatrix matrix;
  for (const Label& label : scene.labels) {
    const LabelType& type = scene.type_of(label);
    matrix.labels.push_back(
        {label.id, type.name, label.position, label.normal, type.requirement(), 0, 0, 16, 65536});
  }
  for (const Transceiver& t : scene.transceivers)
    matrix.transceivers.push_back({t.id, scene.type_of(t).name, t.position, t.axis, 1, t.installed});
  return matrix;
}

inline SignalMatrix matrix_of(const Scene& scene) {
  SignalMatrix matrix = rows_and_columns_of(scene);
  const std::vector<Block> fixtures(scene.fixtures.begin(), scene.fixtures.end());
  std::uint32_t at = 0;
  for (const Label& label : scene.labels)
    for (const Transceiver& t : scene.transceivers) {
      const Vec3 way = t.position - label.position;
      const double r2 = length_squared(way), r = std::sqrt(r2);
      const double cos_label = std::max(0.0, dot(way, label.normal) / r), cos_axis = -dot(way, t.axis) / r;
      const bool seen = std::none_of(fixtures.begin(), fixtures.end(),
                                     [&](const Block& b) { return blocks(b, label.position, t.position); });
      const double direct = seen ? cos_label * 2 * cos_axis * std::sqrt(1 - cos_axis * cos_axis) / r2 : 0;
      const double noise = to_uniform(philox({at++, 0, 0, 0}, 7)[0]);
      const double reflected = r > 14 ? 0 : 0.02 * std::exp(-r / 5) * (0.8 + 0.4 * noise) * (seen ? 1 : 0.4);
      matrix.mean.push_back(static_cast<float>(direct + reflected));
      matrix.direct.push_back(static_cast<float>(direct));
      matrix.standard_error.push_back(
          static_cast<float>((0.002 * direct + 0.03 * reflected) * (0.5 + noise)));
    }
  matrix.provenance = {"0.1.0", "0123456789abcdef0123456789abcdef", 1, "uniform, direct sampled"};
  return matrix;
}

/// A greedy selection, as if a solver had proven it.
inline Placement cover(const SignalMatrix& matrix) {
  Placement placement = place(make_signal_table(matrix), {}, {.solver = SolverChoice::greedy});
  placement.status = Status::optimal;
  placement.count_lower_bound = placement.lower_bound = placement.objective_value;
  placement.solver = {Method::mip, "HiGHS"};
  placement.seconds = 1.25;
  return placement;
}

}  // namespace shelfbeam::sample_store
