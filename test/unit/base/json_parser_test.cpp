#include "shelfbeam/base/json_parser.hpp"

#include <string>
#include <string_view>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/expect_input_error.hpp"

namespace shelfbeam {
namespace {

using namespace std::string_view_literals;
using test::expect_input_error;

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

TEST(JsonParser, OtherCommasAreErrors) {
  for (const std::string_view text : {"[,]", "{,}", "[1,,]", "[,1]", R"({"a":,})", R"({"a",})", "[1],", "[1}",
                                      "[1,}", "[1, /* ]", "[\"1,]", "[1,"})
    expect_input_error([&] { parsed(text); }, "a.json: is not valid JSON");
}

TEST(JsonParser, PositionsAreThoseOfTheFile) {
  expect_input_error([] { parsed("{\"a\": [1,\n],\n\"b\" 2}"); }, "line 3, column 5");
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

}  // namespace
}  // namespace shelfbeam
