#pragma once

#include <string>
#include <vector>

#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam {

/// Collects the parts and triangles of one fixture. Coordinates handed in are local: x along the length, y
/// along the depth, z up, from the corner of least x and y; they are turned about that corner and moved.
class FixtureBuilder {
 public:
  FixtureBuilder(Scene& scene, std::uint32_t fixture, const Vec3& at, double rotation_deg);

  Vec3 point(const Vec3& local) const;
  Vec3 direction(const Vec3& local) const;
  /// The outline in plan of the box between two corners, counter-clockwise.
  std::vector<Vec2> footprint(const Vec3& low, const Vec3& high) const;

  void add_box(PartKind kind, const Vec3& low, const Vec3& high, MaterialId material);
  /// A rectangle of two triangles; `low` and `high` agree in y or in z.
  void add_door(const Vec3& low, const Vec3& high, MaterialId material);
  void add_mesh(const MeshPiece& piece, double scale);
  /// Labels in a row along `face` of a block of the given size, 1 cm off it, at height z.
  void add_label_row(const FixtureLabels& labels, Face face, double size_x, double size_y, double z,
                     int level);

 private:
  Scene& scene_;
  std::uint32_t fixture_;
  Vec3 at_;
  double cos_, sin_;
};

std::string_view face_name(Face face);

/// Outline in plan of a rectangle with its least corner at `at`, turned about it.
std::vector<Vec2> rectangle_footprint(const Vec2& at, double length, double depth, double rotation_deg);

/// Convex hull in plan, counter-clockwise.
std::vector<Vec2> convex_hull(std::vector<Vec2> points);

/// Each adds its outline, parts, triangles and labels to the scene.
void add_fixture(Scene& scene, const Gondola& gondola);
void add_fixture(Scene& scene, const Freezer& freezer);
void add_fixture(Scene& scene, const Box& box);
void add_fixture(Scene& scene, const MeshFixture& mesh);

/// Which of `count` places hold goods at this stocking, and how full each is (1 = to the brim, 0 = empty).
/// Places are filled in an order drawn once from `key`, so more stocking only adds goods; at 1 all are full
/// and alike.
std::vector<double> stock(std::size_t count, double stocking, const std::string& key);

}  // namespace shelfbeam
