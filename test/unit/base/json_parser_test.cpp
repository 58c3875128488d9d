#include "shelfbeam/base/json_parser.hpp"

#include <nlohmann/json.hpp>

#include "support/testing.hpp"

namespace shelfbeam::test {
namespace {

using namespace std::string_view_literals;

std::string parsed(std::string_view text) {
  return parse_json(text, "a.json").dump();
}

TEST(JsonParser, CommasBehindTheLastElementAreIgnored) {
  EXPECT_EQ(parsed("[1,]"), "[1]");
  EXPECT_EQ(parsed(R"({"a": 1, // "b": 2,
                      })"),
            R"({"a":1})");
  EXPECT_EQ(parsed(R"({"a": [1, [2,], {"b": "x",},], /* "c": 3 */ })"), R"({"a":[1,[2],{"b":"x"}]})");
  EXPECT_EQ(parsed(R"(["a,]", "b\",}", ",",])"), R"(["a,]","b\",}",","])") << "texts are left as they are";
  EXPECT_EQ(parsed("[1 // ,]\n]"), "[1]");
}

TEST(JsonParser, OtherTextsAreErrors) {
  for (const std::string_view text :
       {"[,]", "{,}", "[1,,]", "[,1]", R"({"a":,})", R"({"a",})", "[1],", "[1}", "[1,}", "[1, /* ]", "[\"1,]",
        "[1,", "", "{", "[1, 2", "{} {}", "nul", "{'a': 1}"})
    expect_input_error([&] { parsed(text); }, "a.json: is not valid JSON");
}

TEST(JsonParser, PositionsAreThoseOfTheFile) {
  expect_input_error([] { parsed("{\"a\": [1,\n],\n\"b\" 2}"); }, "line 3, column 5");
  expect_input_error([] { parsed("[1,\n 1e999]"); }, "1e999", "line 2");
  expect_input_error([] { parsed("{\"a\": 1,\r\"b\" 2}"); }, "line 2, column 5");
  expect_input_error([] { parsed("{\"a\": 1,\r\n\"b\" 2}"); }, "line 2, column 5");
}

TEST(JsonParser, MarksNullCharactersAndEncodings) {
  EXPECT_EQ(parsed("\xEF\xBB\xBF{}"), "{}");
  EXPECT_EQ(parsed("{}\n\0\0\0"sv), "{}");
  expect_input_error([] { parsed("{}\n\0{}"sv); }, "a.json: line 2", "null character");
  expect_input_error([] { parsed("{\"a\":\n\"b\0\"}"sv); }, "a.json: line 2", "null character");
  expect_input_error([] { parsed("\xFF\xFE{\0}\0"sv); }, "a.json: is UTF-16", "save it as UTF-8");
  expect_input_error([] { parsed("{\n\"a\": \"K\xFChl\"}"); }, "a.json: line 2", "is not UTF-8");
  EXPECT_EQ(parsed("{} // K\xFChl"), "{}") << "comments do not matter";
}

TEST(JsonParser, CharactersOutsideOfTextsAreNamed) {
  expect_input_error([] { parsed("{\n \u201Ca\u201D: 1}"); }, "a.json: line 2", "'\u201C' (U+201C)",
                     "straight double quotes");
  expect_input_error([] { parsed("{\"a\":\u00A01}"); }, "a.json: line 1", "(U+00A0)");
  EXPECT_EQ(parsed("[\"\u201C\"] // \u201C"), "[\"\u201C\"]");
}

TEST(JsonParser, KeepsOrderNumbersAndNesting) {
  const std::string_view text =
      R"({"z":[[],{},[{"b":[1,-2,2.5,1e+300,18446744073709551615]}]],"a":{"c":{"d":null}},"e":[true,false,"x"]})";
  EXPECT_EQ(parsed(text), text);
  EXPECT_EQ(parsed("null"), "null");
  EXPECT_EQ(parsed("7"), "7");
}

TEST(JsonParser, ErrorsHavePaths) {
  expect_input_error([] { parsed(R"({"a": [1, {"b": [[], {"c": 1, "c": 2}]}]})"); },
                     "a.json: a[1].b[1].c: is a duplicate key");
  EXPECT_NO_THROW(parsed(R"({ "a": { "b": 1 }, "b": [ { "b": 1 }, { "b": 2 } ] })"));
  std::string many = "[0, {\"a\": {";
  for (int k = 0; k < 10'000; ++k) many += fmt::format("\"{}\": 0,", k);
  EXPECT_NO_THROW(parsed(many + "}}]"));
  expect_input_error([&] { parsed(many + "\"more\": 0}}]"); }, "a.json: [1].a: has more than 10,000 keys");
}

}  // namespace
}  // namespace shelfbeam::test
