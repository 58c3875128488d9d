#include "shelfbeam/transport/world/label_clusters.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/math/order.hpp"

#include "physics/bare_scene.hpp"

namespace shelfbeam {
namespace {

constexpr std::size_t per_face = 10;

// Two shelves from wall to wall, 2 m apart. Labels are on all four faces in this order: facing the first
// wall, the aisle from both sides, the last wall.
test::BareScene aisle() {
  test::BareScene room;
  const MaterialId paper = room.material(Lambertian{0.5});
  room.box(paper, {0, 0, 0}, {8, 6.4, 3});
  room.box(paper, {0, 1.6, 0}, {8, 2.2, 2.6});
  room.box(paper, {0, 4.2, 0}, {8, 4.8, 2.6});
  for (const auto& [y, normal] : {std::pair{1.599, -1.0}, {2.201, 1.0}, {4.199, -1.0}, {4.801, 1.0}})
    for (std::uint32_t k = 0; k < per_face; ++k)
      room.label({0.8 + 0.7 * k, y, k % 2 == 0 ? 0.8 : 1.3}, {0, normal, 0});
  room.unit({4, 3, 2.9}, {0, 0, -1}, SinTwoTheta{1});
  return room;
}

std::vector<std::size_t> cluster_of_labels(const std::vector<LabelCluster>& clusters, std::size_t labels) {
  std::vector<std::size_t> result(labels, clusters.size());
  for (std::size_t c = 0; c < clusters.size(); ++c)
    for (const std::uint32_t i : clusters[c]) result[i] = c;
  return result;
}

TEST(LabelClusters, AreAPartitionIntoSmallParts) {
  const test::BareScene room = aisle();
  const World world(room.scene);
  for (const std::size_t most : {1U, 3U, 7U, 96U}) {
    const auto clusters = cluster_labels(world, all_numbers<LabelId>(world.receivers.size()), most);
    std::vector<LabelId> all;
    for (const LabelCluster& cluster : clusters) {
      EXPECT_FALSE(cluster.empty());
      EXPECT_LE(cluster.size(), most);
      EXPECT_TRUE(std::is_sorted(cluster.begin(), cluster.end()));
      all.insert(all.end(), cluster.begin(), cluster.end());
    }
    std::sort(all.begin(), all.end());
    EXPECT_EQ(all, all_numbers<LabelId>(4 * per_face));
  }
}

TEST(LabelClusters, SidesOfAnAisleBelongTogetherFacesOfAShelfDoNot) {
  const test::BareScene room = aisle();
  const World world(room.scene);
  const auto clusters = cluster_labels(world, all_numbers<LabelId>(world.receivers.size()), 96);
  ASSERT_EQ(clusters.size(), 3U);
  const auto cluster = cluster_of_labels(clusters, 4 * per_face);
  for (std::uint32_t k = 1; k < per_face; ++k)
    for (std::uint32_t face = 0; face < 4; ++face)
      EXPECT_EQ(cluster[face * per_face + k], cluster[face * per_face]);
  EXPECT_NE(cluster[0], cluster[per_face]);
  EXPECT_EQ(cluster[per_face], cluster[2 * per_face]);
  EXPECT_NE(cluster[2 * per_face], cluster[3 * per_face]);
}

TEST(LabelClusters, RoomsAreApart) {
  for (const bool has_wall : {true, false}) {
    test::BareScene rooms;
    const MaterialId paper = rooms.material(Lambertian{0.5});
    rooms.box(paper, {0, 0, 0}, {8, 4, 3});
    if (has_wall) rooms.quad(paper, {4, 0, 0}, {0, 4, 0}, {0, 0, 3});
    for (std::uint32_t k = 0; k < 8; ++k) rooms.label({0.5 + k, 0.01, 1}, {0, 1, 0});
    rooms.unit({3, 3, 2.9}, {0, 0, -1}, SinTwoTheta{1});
    const World world(rooms.scene);
    EXPECT_EQ(cluster_labels(world, all_numbers<LabelId>(world.receivers.size()), 96).size(),
              has_wall ? 2U : 1U);
  }
}

// Glass doors in front of the labels on one side of an aisle; the control has wooden doors.
TEST(LabelClusters, GlassDoorsDoNotSplitAnAisle) {
  for (const bool is_glass : {true, false}) {
    test::BareScene room = aisle();
    const MaterialId door =
        room.material(is_glass ? Material(make_thin_dielectric(1.5, 0.005, 0)) : Lambertian{0.5});
    room.quad(door, {0, 2.25, 0}, {8, 0, 0}, {0, 0, 2.6});
    const World world(room.scene);
    const auto cluster = cluster_of_labels(
        cluster_labels(world, all_numbers<LabelId>(world.receivers.size()), 96), 4 * per_face);
    EXPECT_EQ(cluster[per_face] == cluster[2 * per_face], is_glass);
    EXPECT_EQ(cluster[per_face], cluster[2 * per_face - 1]);
  }
}

}  // namespace
}  // namespace shelfbeam
