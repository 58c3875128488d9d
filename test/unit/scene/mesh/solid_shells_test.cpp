#include "shelfbeam/scene/mesh/solid_shells.hpp"

#include "support/testing.hpp"

// Solids made of blocks, wound and listed in all ways. The result is compared with the medium on both sides
// of every triangle, which is known from the blocks, and with the volume of the glass.

namespace shelfbeam::test {
namespace {

struct Block {
  Vec3 low, high;
  bool other_diagonals = false;

  bool contains(const Vec3& p) const {
    return p.x > low.x && p.x < high.x && p.y > low.y && p.y < high.y && p.z > low.z && p.z < high.z;
  }
};

using SolidTriangles = std::vector<SolidTriangle>;

// The twelve triangles of a block, facing outwards or inwards.
SolidTriangles surface(const Block& block, bool outwards) {
  const auto corner = [&](int k) {
    return Vec3{(k & 1) != 0 ? block.high.x : block.low.x, (k & 2) != 0 ? block.high.y : block.low.y,
                (k & 4) != 0 ? block.high.z : block.low.z};
  };
  constexpr int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                               {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  SolidTriangles triangles;
  for (const auto& face : faces) {
    const int s = block.other_diagonals ? 1 : 0;
    for (const auto& [i, j, k] : {std::array{s, s + 1, s + 2}, std::array{s, s + 2, (s + 3) % 4}})
      triangles.push_back(
          {{corner(face[i]), corner(face[outwards ? j : k]), corner(face[outwards ? k : j])}});
  }
  return triangles;
}

struct Case {
  std::string name;
  std::vector<Block> blocks;
  double volume;

  // The blocks are apart, nested or touch.
  bool is_glass(const Vec3& p) const {
    return std::count_if(blocks.begin(), blocks.end(), [&](const Block& b) { return b.contains(p); }) % 2 ==
           1;
  }
};

std::vector<Case> cases() {
  const Block one{{0, 0, 0}, {1, 1, 1}}, bubble{{0.2, 0.3, 0.4}, {0.5, 0.6, 0.7}};
  const auto at = [](double x, double y, double z) { return Block{{x, y, z}, {x + 1, y + 1, z + 1}}; };
  const auto other_diagonals = [](Block block) {
    block.other_diagonals = true;
    return block;
  };
  return {{"one", {one}, 1},
          {"apart", {one, {{2, 0.3, 0.1}, {2.5, 0.8, 0.6}}}, 1.125},
          {"bubble", {one, bubble}, 1 - 0.027},
          {"two bubbles", {one, bubble, {{0.6, 0.3, 0.4}, {0.7, 0.6, 0.7}}}, 1 - 0.027 - 0.009},
          {"glass in a bubble",
           {one, {{0.2, 0.2, 0.2}, {0.8, 0.8, 0.8}}, {{0.4, 0.4, 0.4}, {0.6, 0.6, 0.6}}, at(3, 0, 0)},
           1 - 0.216 + 0.008 + 1},
          {"equal faces", {one, at(1, 0, 0)}, 2},
          {"equal faces, other diagonals", {one, other_diagonals(at(1, 0, 0))}, 2},
          {"three in a row", {one, at(1, 0, 0), {{2, 0, 0}, {2.25, 1, 1}, true}}, 2.25},
          {"eight around a corner",
           {one, at(1, 0, 0), at(0, 1, 0), other_diagonals(at(1, 1, 0)), at(0, 0, 1), at(1, 0, 1),
            at(0, 1, 1), at(1, 1, 1)},
           8},
          {"equal edges", {one, at(1, 1, 0)}, 2},
          {"equal corners", {one, at(1, 1, 1)}, 2},
          {"small on large", {one, {{0.2, 0.3, 1}, {0.7, 0.8, 1.5}}}, 1.125},
          {"small on large at an edge", {one, {{0, 0, 1}, {1, 0.5, 1.5}}}, 1.25},
          {"shifted faces", {one, at(1, 0.25, 0.5)}, 2},
          {"bubble at the wall", {one, {{0, 0.25, 0.25}, {0.5, 0.75, 0.75}}}, 0.875},
          {"bubble with an edge of the wall", {one, {{0, 0, 0}, {0.5, 0.5, 1}}}, 0.75},
          {"bubble with a face of the wall", {one, {{0, 0, 0}, {0.5, 1, 1}}}, 0.5},
          {"far away",
           {{{900, 0, 0}, {900.5, 0.5, 0.5}}, {{900.125, 0.125, 0.125}, {900.25, 0.25, 0.25}}},
           0.125 - 0.125 * 0.125 * 0.125}};
}

double volume(const SolidTriangles& triangles) {
  const Vec3 origin = triangles[0].corners[0] + Vec3{0.3, 0.4, 0.5};
  double six = 0;
  for (const auto& [corners, has_area] : triangles)
    six += dot(corners[0] - origin, cross(corners[1] - origin, corners[2] - origin));
  return six / 6;
}

SolidTriangles oriented(SolidTriangles triangles, const std::vector<Facing>& facings) {
  SolidTriangles result;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    auto& corners = triangles[t].corners;
    if (facings[t] == Facing::inwards) std::swap(corners[1], corners[2]);
    if (facings[t] != Facing::repeated) result.push_back(triangles[t]);
  }
  return result;
}

// The number of triangles with the wrong medium behind or before them.
int wrong_sides(const SolidTriangles& triangles, const Case& solid) {
  int wrong = 0;
  for (const auto& [corners, has_area] : triangles) {
    const auto& [a, b, c] = corners;
    const Vec3 inner = 0.37 * a + 0.34 * b + 0.29 * c, step = normalized(cross(b - a, c - a)) * 1e-3;
    const bool before = solid.is_glass(inner + step), behind = solid.is_glass(inner - step);
    if (before != behind && before) ++wrong;  // glass on both sides: two equal faces
  }
  return wrong;
}

// Reverses some triangles, all of one block or single ones, and shuffles them.
SolidTriangles disturbed(const std::vector<Block>& blocks, std::mt19937& random, bool by_block) {
  SolidTriangles triangles;
  for (const Block& block : blocks) {
    const bool outwards = random() % 2 == 0;
    for (SolidTriangle& triangle : surface(block, outwards)) {
      if (!by_block && random() % 2 == 0) std::swap(triangle.corners[1], triangle.corners[2]);
      triangles.push_back(triangle);
    }
  }
  for (std::size_t k = triangles.size(); k > 1; --k) std::swap(triangles[k - 1], triangles[random() % k]);
  return triangles;
}

TEST(SolidShells, FaceAwayFromTheGlass) {
  std::mt19937 random(1);
  for (const Case& solid : cases())
    for (int k = 0; k < 40; ++k) {
      const SolidTriangles given = disturbed(solid.blocks, random, k % 2 == 0);
      const auto found = facings(given);
      ASSERT_TRUE(found);
      const SolidTriangles result = oriented(given, *found);
      ASSERT_EQ(result.size(), given.size()) << solid.name;
      ASSERT_EQ(std::count(found->begin(), found->end(), Facing::open), 0) << solid.name;
      ASSERT_EQ(wrong_sides(result, solid), 0) << solid.name << ' ' << k;
      // Equal faces between two blocks cancel only if they face each other.
      ASSERT_NEAR(volume(result), solid.volume, 1e-9) << solid.name << ' ' << k;
    }
}

// A turn by no special angle changes nothing, also if it is rounded to single precision.
TEST(SolidShells, NeedNoAxes) {
  const Vec3 z = normalized({0.3, 0.5, 0.7}), x = normalized(cross({0, 1, 0}, z)), y = cross(z, x);
  std::mt19937 random(2);
  for (const Case& solid : cases()) {
    const SolidTriangles given = disturbed(solid.blocks, random, false);
    SolidTriangles turned = given;
    for (SolidTriangle& triangle : turned)
      for (Vec3& p : triangle.corners) {
        const auto single = [](double v) { return static_cast<double>(static_cast<float>(v)); };
        p = {single(dot(x, p)), single(dot(y, p)), single(dot(z, p))};
      }
    const auto found = facings(turned);
    ASSERT_TRUE(found);
    EXPECT_EQ(wrong_sides(oriented(given, *found), solid), 0) << solid.name;
    EXPECT_NEAR(volume(oriented(given, *found)), solid.volume, 1e-9) << solid.name;
  }
}

// A seam whose corners differ by the rounding of single precision is closed, a wider one is not.
TEST(SolidShells, SeamsMayBeRounded) {
  for (const double gap : {0.0, 1e-7, 1e-5}) {
    SolidTriangles triangles = surface({{0, 0, 0}, {1, 1, 1}}, false);
    for (std::size_t t = 0; t < 4; ++t)  // bottom and top
      for (Vec3& p : triangles[t].corners) p.x += gap;
    const auto found = facings(triangles);
    EXPECT_EQ(std::count(found->begin(), found->end(), gap > 1e-6 ? Facing::open : Facing::inwards), 12)
        << gap;
  }
}

// A thin sheet far from the origin has corners closer to each other than the rounding there.
TEST(SolidShells, CornersOfATriangleAreNeverTheSame) {
  const auto found = facings(surface({{5000, 0, 0}, {5001, 1, 0.0003}}, false));
  EXPECT_EQ(std::count(found->begin(), found->end(), Facing::inwards), 12);
}

// The handle of a cup reaches into its wall: neither shell is within the other.
TEST(SolidShells, OverlappingShellsFaceOutwards) {
  std::mt19937 random(3);
  const std::vector<Block> blocks = {{{0, 0, 0}, {1, 1, 1}}, {{0.7, 0.4, 0.4}, {1.4, 0.6, 0.6}}};
  for (int k = 0; k < 20; ++k) {
    const SolidTriangles given = disturbed(blocks, random, k % 2 == 0);
    EXPECT_NEAR(volume(oriented(given, *facings(given))), 1 + 0.7 * 0.2 * 0.2, 1e-9);
  }
}

TEST(SolidShells, OfWhichTwoAreEqualAreListedOnce) {
  std::mt19937 random(4);
  const Block one{{0, 0, 0}, {1, 1, 1}}, bubble{{0.2, 0.3, 0.4}, {0.5, 0.6, 0.7}};
  const SolidTriangles given = disturbed({one, bubble, one, bubble}, random, false);
  const auto found = facings(given);
  EXPECT_EQ(std::count(found->begin(), found->end(), Facing::repeated), 24);
  EXPECT_NEAR(volume(oriented(given, *found)), 1 - 0.027, 1e-9);
}

TEST(SolidShells, OpenShellsAreLeftAlone) {
  SolidTriangles triangles = surface({{0, 0, 0}, {1, 1, 1}}, false),
                 box = surface({{2, 0, 0}, {3, 1, 1}}, false);
  triangles.pop_back();
  triangles.insert(triangles.end(), box.begin(), box.end());
  const auto found = facings(triangles);
  EXPECT_EQ(std::count(found->begin(), found->begin() + 11, Facing::open), 11);
  EXPECT_EQ(std::count(found->begin() + 11, found->end(), Facing::inwards), 12);
}

// 2,000 bubbles take a moment, and boxes in boxes without end are refused.
TEST(SolidShells, WorkIsBounded) {
  SolidTriangles foam = surface({{-1, -1, -1}, {21, 21, 21}}, true), nested;
  for (int k = 0; k < 2000; ++k) {
    const Vec3 low{1.0 * (k % 20), 1.0 * (k / 20 % 20), 1.0 * (k / 400)};
    const SolidTriangles one = surface({low, low + Vec3{0.5, 0.5, 0.5}}, k % 2 == 0);
    foam.insert(foam.end(), one.begin(), one.end());
  }
  const auto found = facings(foam);
  ASSERT_TRUE(found);
  EXPECT_NEAR(volume(oriented(foam, *found)), 22.0 * 22 * 22 - 250, 1e-6);
  for (int k = 0; k < 2000; ++k) {
    const double side = 1 + k;
    const SolidTriangles one = surface({{-side, -side, -side}, {side, side, side}}, true);
    nested.insert(nested.end(), one.begin(), one.end());
  }
  EXPECT_FALSE(facings(nested));
}

}  // namespace
}  // namespace shelfbeam::test
