#include "support/testing.hpp"
#include "unit/scene/store/list_store.hpp"

namespace shelfbeam::test {
namespace {

// A gondola of two segments on each side, a freezer and a table. test/data/refused/labels.jsonc has the
// faults.
class SegmentPlacesTest : public testing::Test {
 protected:
  SegmentPlacesTest() {
    store_["fixtures"] = R"([
      {"type": "gondola", "id": "G", "at": [5, 5], "length": 2, "depth": 1, "height": 1.8, "material": "steel",
       "shelves": [0.4, 0.9, 1.4]},
      {"type": "freezer", "id": "F", "at": [10, 5], "length": 2, "depth": 1, "height": 0.9, "material": "steel"},
      {"type": "box", "id": "T", "at": [15, 5, 0], "size": [1, 1, 0.75], "material": "steel"}])"_json;
  }
  std::vector<Label> labels(const std::string& segments, const std::string& csv) {
    store_["planogram"]["segments"] = Json::parse(segments);
    folder_.write("p.csv", csv);
    return scene_of(store_, folder_.path()).labels;
  }

  TempFolder folder_;
  Json store_ = planogram_store();
};

void expect_label(const Label& label, std::string_view id, const Vec3& position, int board) {
  EXPECT_EQ(label.id, id);
  EXPECT_NEAR(length(label.position - position), 0, 1e-12) << id << " at x = " << label.position.x;
  EXPECT_EQ(label.place.board, board) << id;
}

const std::string two_segments =
    "UPC,Name,Planogram,Segment,Shelf,Position\n"
    "11,Rolls,P,1,1,2\n12,Rusk,P,1,1,1\n21,Jam,P,2,3,1\n22,Tea,P,2,1,7\n";

TEST_F(SegmentPlacesTest, ShareAFaceFromLeftToRight) {
  const auto front = labels(R"([{"planogram": "P", "fixture": "G", "face": "front"}])", two_segments);
  ASSERT_EQ(front.size(), 4U);
  expect_label(front[0], "11", {5.75, 4.99, 0.4}, 1);
  expect_label(front[1], "12", {5.25, 4.99, 0.4}, 1);
  expect_label(front[2], "21", {6.5, 4.99, 1.4}, 3);
  expect_label(front[3], "22", {6.5, 4.99, 0.4}, 1);
  EXPECT_EQ(front[2].description, "Jam");
  expect_place(front[2], {.fixture = "G", .face = Face::front, .board = 3, .along = 1.5});
  // A person before the back has x = 7 on the left.
  const auto back = labels(R"([{"fixture": "G", "face": "back", "segments": [1, 2]}])", two_segments);
  expect_label(back[0], "11", {6.25, 6.01, 0.4}, 1);
  expect_label(back[1], "12", {6.75, 6.01, 0.4}, 1);
  expect_label(back[2], "21", {5.5, 6.01, 1.4}, 3);
  // The list names them from the left.
  for (const auto& [mirror, first, second] :
       {std::tuple("", 6.75, 5.5), std::tuple(R"(, "right_to_left": true)", 5.25, 6.5)}) {
    const auto swapped = labels(
        fmt::format(R"([{{"fixture": "G", "face": "front", "segments": [2, 1]{}}}])", mirror), two_segments);
    expect_label(swapped[0], "11", {first, 4.99, 0.4}, 1);
    expect_label(swapped[2], "21", {second, 4.99, 1.4}, 3);
  }
  const auto reversed =
      labels(R"([{"fixture": "G", "face": "front", "right_to_left": true, "from_top": true}])", two_segments);
  expect_label(reversed[0], "11", {6.25, 4.99, 1.4}, 3);
  expect_label(reversed[2], "21", {5.5, 4.99, 0.4}, 1);
}

TEST_F(SegmentPlacesTest, StandOnPartsOfSeveralFixtures) {
  const auto all = labels(R"([{"segments": [1], "fixture": "G", "face": "back", "from": 0.5, "to": 1.5},
    {"segments": [2], "fixture": "F", "face": "left", "first_shelf": 3},
    {"segments": [1], "fixture": "T", "face": "top"}])",
                          "article;bay;shelf;sequence;hook\n1;1;1;1;\n2;1;1;2;0,1\n1;2;3;1;\n");
  ASSERT_EQ(all.size(), 5U);
  expect_label(all[0], "1", {6.25, 6.01, 0.4}, 1);
  expect_label(all[1], "1/2", {15.25, 5.5, 0.76}, 0);
  expect_label(all[2], "2", {5.75, 6.1, 0.4}, 1);
  expect_label(all[3], "2/2", {15.75, 5.5, 0.76}, 0);
  expect_label(all[4], "1/3", {9.99, 5.5, 0.85}, 1);
  EXPECT_EQ(all[1].normal, (Vec3{0, 0, 1}));
  EXPECT_EQ(all[4].normal, (Vec3{-1, 0, 0}));
}

TEST_F(SegmentPlacesTest, ShareAShelfByTheWidthsOfFacings) {
  const char* const member = R"([{"fixture": "G", "face": "front", "first_shelf": 0}])";
  // 0.1 x 2, the mean of 0.2 and 0.1, and 0.2 of 0.55
  const auto wide = labels(member,
                           "article,segment,shelf,sequence,width,facings\n"
                           "1,5,0,1,0.1,2\n2,5,0,2,,\n3,5,0,3,0.2,1\n");
  expect_label(wide[0], "1", {5 + 2 * 0.1 / 0.55, 4.99, 0.4}, 1);
  expect_label(wide[1], "2", {5 + 2 * 0.275 / 0.55, 4.99, 0.4}, 1);
  expect_label(wide[2], "3", {5 + 2 * 0.45 / 0.55, 4.99, 0.4}, 1);
  const auto faced = labels(member, "article,segment,shelf,sequence,HFacings\n1,5,2,1,3\n2,5,2,1,1\n");
  expect_label(faced[0], "1", {5.75, 4.99, 1.4}, 3);
  expect_label(faced[1], "2", {6.75, 4.99, 1.4}, 3);
}

// Both columns of a planogram and of a description are usual, and one of each is enough.
TEST_F(SegmentPlacesTest, TakeOneOfTwoColumns) {
  const auto one = labels(R"([{"planogram": "A", "fixture": "G", "face": "front"}])",
                          "article,segment,shelf,sequence,planogram_name,planogram_id,name,description\n"
                          "1,1,1,1,Bakery,A,x,Rye bread\n");
  EXPECT_EQ(one.at(0).description, "Rye bread");
}

}  // namespace
}  // namespace shelfbeam::test
