#include "shelfbeam/base/json.hpp"

#include "support/processor_time.hpp"
#include "support/sanitizers.hpp"
#include "support/testing.hpp"

namespace shelfbeam::test {
namespace {

JsonCursor parse(std::string_view text) {
  return JsonCursor::parse(text, "store.json");
}

TEST(Json, ReadsValues) {
  const JsonCursor root = parse(R"({ "b": 2.5, "a": [1, 2, 3], /* why */ "text": "é", // and where
                                     "yes": true, "whole": -7 })");
  EXPECT_TRUE(root.is_object());
  EXPECT_EQ(root["b"].number(), 2.5);
  EXPECT_EQ(root["a"].numbers(3), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(root["a"].elements()[1].number(), 2);
  EXPECT_EQ(root["text"].text(), "é");
  EXPECT_TRUE(root["yes"].boolean());
  EXPECT_EQ(root["whole"].integer(-10, 10), -7);
  EXPECT_EQ(root["text"].choice({"e", "é"}), "é");
  EXPECT_FALSE(root.find("c").has_value());
  std::string order;
  for (const auto& [key, value] : root.members()) order += key + " ";
  EXPECT_EQ(order, "b a text yes whole ") << "members come in the order of the file";
  EXPECT_NO_THROW(root.expect_keys({"a", "b", "text", "yes", "whole", "more"}));
}

TEST(Json, ErrorsNameFileAndPath) {
  const JsonCursor root =
      parse(R"({ "fixtures": [ {}, { "labels": { "spacing": -1, "face": "fromt", "at": [1, "x"] } } ],
                                     "name": null })");
  const JsonCursor labels = root["fixtures"].elements()[1]["labels"];
  const std::string place = "store.json: fixtures[1].labels";
  EXPECT_EQ(labels.where(), place);
  EXPECT_EQ(root.where(), "store.json");
  const JsonCursor spacing = labels["spacing"];
  expect_input_error([&] { labels["depth"]; }, place, "'depth'");
  expect_input_error([&] { spacing.positive(); }, place + ".spacing: ", "-1");
  expect_input_error([&] { spacing.non_negative(); }, place + ".spacing: ", "-1");
  expect_input_error([&] { spacing.number(0, 1); }, place + ".spacing: ", "-1", "0 to 1");
  expect_input_error([&] { spacing.integer(0, 5); }, place + ".spacing: ", "-1", "0 to 5");
  expect_input_error([&] { parse("[0.5]").elements()[0].integer(0, 5); }, "store.json: [0]: ", "0.5");
  expect_input_error([&] { spacing.text(); }, place + ".spacing: ");
  expect_input_error([&] { spacing.boolean(); }, place + ".spacing: ");
  expect_input_error([&] { spacing.elements(); }, place + ".spacing: ");
  expect_input_error([&] { spacing["x"]; }, place + ".spacing: ");
  expect_input_error([&] { spacing.members(); }, place + ".spacing: ");
  expect_input_error([&] { labels["at"].numbers(); }, place + ".at[1]: ");
  expect_input_error([&] { labels["at"].numbers(3); }, place + ".at");
  expect_input_error([&] { parse("[1, 2]").numbers(3); }, "store.json: ", "2", "3");
  expect_input_error([&] { root["name"].text(); }, "store.json: name: ");
  expect_input_error([&] { labels["face"].choice({"front", "back"}); }, place + ".face: ", "'front'");
  expect_input_error([&] { labels.fail("is odd", "make it even"); }, place + ": is odd; make it even");
}

TEST(Json, UnknownKeysNameTheNearest) {
  const JsonCursor root = parse(R"({ "reflectanse": 1 })");
  expect_input_error([&] { root.expect_keys({"roughness", "reflectance"}); }, "'reflectanse'",
                     "'reflectance'");
  expect_input_error([&] { root.expect_keys({"x", "y"}); }, "'reflectanse'", "x, y");
}

// A time that grows with the square of the elements would be a hundred times as long.
TEST(Json, LongListsTakeTimeInProportion) {
  std::string text = "[0";
  for (int k = 0; k < 200'000; ++k) text += ",{\"a\":1}";
  const ProcessorTime time;
  EXPECT_EQ(parse(text + "]").elements().size(), 200'001U);
  EXPECT_LT(time.seconds(), 4 * slowness);
}

TEST(Json, ReadsFiles) {
  const TempFolder folder;
  EXPECT_EQ(JsonCursor::parse_file(folder.write("a.json", "[4]")).elements()[0].number(), 4);
  expect_input_error([&] { JsonCursor::parse_file(folder / "b.json"); }, (folder / "b.json").string());
  expect_input_error([&] { JsonCursor::parse_file(folder.path()); }, folder.path().string());
}

}  // namespace
}  // namespace shelfbeam::test
