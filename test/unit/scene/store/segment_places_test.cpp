#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/expect_input_error.hpp"
#include "support/temp_folder.hpp"
#include "unit/scene/store/list_store.hpp"

namespace shelfbeam {
namespace {

using test::Json;
using test::read;
using test::store_with;
using test::TempFolder;

// A gondola of two segments on each side, a freezer and a table.
class SegmentPlacesTest : public testing::Test {
 protected:
  SegmentPlacesTest() {
    store_ = store_with(R"([
    {"type": "gondola", "id": "G", "at": [5, 5], "length": 2, "depth": 1, "height": 1.8, "material": "steel",
     "shelves": [0.4, 0.9, 1.4]},
    {"type": "freezer", "id": "F", "at": [10, 5], "length": 2, "depth": 1, "height": 0.9, "material": "steel"},
    {"type": "box", "id": "T", "at": [15, 5, 0], "size": [1, 1, 0.75], "material": "steel"},
    {"type": "cylinder", "id": "C", "at": [20, 5], "radius": 0.3, "top": 2, "material": "steel"}])");
    store_["labels"] = Json::array();
    store_["planogram"] = {{"file", "p.csv"}, {"type", "small"}};
  }

  std::vector<Label> labels(const char* segments, const std::string& csv) {
    store_["planogram"]["segments"] = Json::parse(segments);
    folder_.write("p.csv", csv);
    return make_scene(read(store_, folder_.path())).labels;
  }
  void expect_error(const char* segments, const std::string& csv, std::string_view message) {
    SCOPED_TRACE(message);
    test::expect_input_error([&] { labels(segments, csv); }, message);
  }

  TempFolder folder_;
  Json store_;
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
  EXPECT_EQ(front[2].place,
            (LabelPlace{.fixture = "G", .face = Face::front, .board = 3, .along = front[2].position.x - 5}));
  // A person before the back has x = 7 on the left.
  const auto back = labels(R"([{"fixture": "G", "face": "back", "segments": [1, 2]}])", two_segments);
  expect_label(back[0], "11", {6.25, 6.01, 0.4}, 1);
  expect_label(back[1], "12", {6.75, 6.01, 0.4}, 1);
  expect_label(back[2], "21", {5.5, 6.01, 1.4}, 3);
  // The list names them from the left.
  for (const auto& [mirror, first, second] :
       {std::tuple("", 6.75, 5.5), std::tuple(R"(, "right_to_left": true)", 5.25, 6.5)}) {
    const auto swapped = labels(
        (R"([{"fixture": "G", "face": "front", "segments": [2, 1])" + std::string(mirror) + "}]").c_str(),
        two_segments);
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

TEST_F(SegmentPlacesTest, RefuseFaultsWithTheirPlace) {
  const std::string header = "article,segment,shelf,sequence\n";
  const char* const front = R"([{"segments": [1], "fixture": "G", "face": "front"}])";
  for (const auto& [rows, message] : std::vector<std::pair<const char*, const char*>>{
           {"1,1,1,1\n1,2,1,1\n", "p.csv: line 3, field 2: names segment 2, which 'segments' of the store's"},
           {"1,1,4,1\n", "p.csv: line 2, field 3: is shelf 4, but the front of 'G' has 3 boards; use 1 to 3"},
           {"1,1,0,1\n", "field 3: is shelf 0, but the front of 'G' has 3 boards"},
           {"1,1,1.5,1\n", "field 3: is 1.5; use a whole number"},
           {"1,1,1,-1\n", "p.csv: line 2, field 4: "},
           {"1,1,1,2\n2,1,1,1\n1,1,1,2\n",
            "p.csv: line 4: has article '1' again at sequence 2 of shelf 1; remove one"},
           {"1,1,1\n", "p.csv: line 2: has 3 fields"}})
    expect_error(front, header + rows, message);
  EXPECT_EQ(labels(front, header + "1,1,1,2\n2,1,1,1\n1,1,1,3\n").size(), 3U);
  const std::string good = header + "1,1,1,1\n";
  for (const auto& [segments, message] : std::vector<std::pair<const char*, const char*>>{
           {R"([])", "planogram.segments: is empty"},
           {R"([{"fixture": "X", "face": "front"}])",
            "planogram.segments[0].fixture: names the unknown fixture 'X'"},
           {R"([{"fixture": "C", "face": "front"}])", "segments[0].fixture: names a fixture without boards"},
           {R"([{"fixture": "G", "face": "left"}])",
            "segments[0].face: is not a face of the fixture; use one of front, back"},
           {R"([{"fixture": "G", "face": "top"}])", "segments[0].face: is not a face of the fixture"},
           {R"([{"fixture": "G", "face": "front", "to": 3}])",
            "segments[0].to: is 3 m, beyond the face of 2 m"},
           {R"([{"fixture": "G", "face": "front", "from": 2}])",
            "segments[0].from: is 2 m, not before the end"},
           {R"([{"fixture": "G", "face": "front", "segments": [1.5]}])",
            "segments[0].segments[0]: is not the number of a segment"},
           {R"([{"fixture": "G", "face": "front", "segments": [1, 1]}])", "segments[1]: is a duplicate"},
           {R"([{"fixture": "G", "face": "front", "segments": [1, 2]}])",
            "planogram.segments[0].segments[1]: names segment 2, which the file does not have"},
           {R"([{"fixture": "G", "face": "front", "planogram": "P"}, {"fixture": "G", "face": "front"}])",
            "segments[0].planogram: names a planogram, but the file has no column 'planogram'"}})
    expect_error(segments, good, message);
  expect_error(R"([{"fixture": "G", "face": "front", "planogram": "Q"}])", two_segments,
               "names segment 1 of planogram 'P', which 'segments'");
  expect_error(R"([{"fixture": "G", "face": "front"}, {"fixture": "G", "face": "back", "planogram": "Q"}])",
               two_segments, "segments[1].planogram: names 'Q', which the file does not have");
  expect_error(R"([{"fixture": "G", "face": "front"}])", two_segments + "1,Salt,Q,1,1,1\n",
               "planogram.segments[0]: does not name its planogram, but the file has 2; add 'planogram'");
  expect_error(front, "article,segment,shelf\n", "p.csv: line 1: has no column 'sequence'");
  for (const auto& [first_line, message] : std::vector<std::pair<const char*, const char*>>{
           {"UPC,EAN,segment,shelf,sequence",
            "p.csv: line 1: has both columns 'upc' and 'ean'; remove or rename one of the two"},
           {"article,segment,shelf,level,sequence", "has both columns 'shelf' and 'level'"},
           {"article,segment,shelf,sequence,Name,name",
            "p.csv: line 1: has several columns 'name'; rename or remove all but one"}})
    expect_error(front, std::string(first_line) + "\n1,1,1,1,1,1\n", message);
  // Both are usual, and one of them is enough.
  EXPECT_EQ(labels(R"([{"planogram": "A", "fixture": "G", "face": "front"}])",
                   "article,segment,shelf,sequence,planogram_name,planogram_id,name,description\n"
                   "1,1,1,1,Bakery,A,x,Rye bread\n")
                .front()
                .description,
            "Rye bread");
  expect_error(R"([{"fixture": "T", "face": "top"}])", "article,segment,shelf,sequence,hook\n1,1,1,1,0.1\n",
               "p.csv: line 2, field 5: does not apply to labels on the top");
  store_["planogram"].erase("segments");
  folder_.write("p.csv", good);
  test::expect_input_error([&] { read(store_, folder_.path()); },
                           std::string_view("names segments instead of fixtures; add 'segments'"));
}

}  // namespace
}  // namespace shelfbeam
