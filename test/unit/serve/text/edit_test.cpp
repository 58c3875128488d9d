#include "serve/text/edit.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/base/json_parser.hpp"

#include "edit_ops.hpp"
#include "support/expect_input_error.hpp"

namespace shelfbeam::serve {
namespace {

using Ops = std::vector<EditOp>;

std::string text_after(const std::string& text, const Ops& ops) {
  const EditedText result = edited(text, ops);
  EXPECT_EQ(spliced(result.text, inverse(result.splices)), text) << "does not lead back";
  return result.text;
}

TEST(Edit, SetChangesOnlyTheBytesOfTheValue) {
  EXPECT_EQ(text_after("{ \"at\": [5, 4.60], // metres\n  \"b\" :1}", {to_set("/at/0", 5, 5.25)}),
            "{ \"at\": [5.25, 4.60], // metres\n  \"b\" :1}");
  EXPECT_EQ(text_after("{ \"a\": \"b\" }", {to_set("/a", "b", {1, 2})}), "{ \"a\": [1, 2] }");
  EXPECT_EQ(text_after("// c\n1 // d", {to_set("", 1, Json::object())}), "// c\n{} // d");
}

TEST(Edit, AnEqualValueChangesNoByte) {
  const std::string text = "{ \"a\": [1.0, 2e0], \"b\": { \"x\": 1, \"y\": 2 } }";
  EXPECT_EQ(text_after(text, {to_set("/a", {1, 2}, {1.0, 2})}), text);
  EXPECT_EQ(text_after(text, {to_set("/b", {{"y", 2}, {"x", 1.0}}, {{"y", 2}, {"x", 1}})}), text);
}

TEST(Edit, SetKeepsEqualPartsOfAList) {
  EXPECT_EQ(text_after("[ [1, 2], /* b */ [3, 4] ]", {to_set("", {{1, 2}, {3, 4}}, {{1, 2}, {3, 5}})}),
            "[ [1, 2], /* b */ [3, 5] ]");
  EXPECT_EQ(text_after("[1.0, /* two */ 2.0, 3.0]", {to_set("", {1, 2, 3}, {1, 3})}), "[1.0, 3.0]");
  EXPECT_EQ(text_after("[1.0, /* three */ 3.0]", {to_set("", {1, 3}, {0, 1, 2, 3})}),
            "[0, 1, 2, /* three */ 3.0]");
  EXPECT_EQ(text_after("[1.0, 4.0]", {to_set("", {1, 4}, {1, 2, 3, 4})}), "[1.0, 2, 3, 4.0]");
}

TEST(Edit, SetKeepsEqualMembersOfAnObject) {
  EXPECT_EQ(text_after("{ \"a\": 1.0, // one\n  \"b\": 2 // two\n}",
                       {to_set("", {{"a", 1}, {"b", 2}}, {{"c", 3}, {"a", 1}})}),
            "{ \"a\": 1.0, // one\n  \"c\": 3\n}");
}

TEST(Edit, InsertsIntoLists) {
  EXPECT_EQ(text_after("[1, 2]", {to_insert("/0", 0)}), "[0, 1, 2]");
  EXPECT_EQ(text_after("[1, 2]", {to_insert("/1", 0)}), "[1, 0, 2]");
  EXPECT_EQ(text_after("[1, 2]", {to_insert("/2", 0)}), "[1, 2, 0]");
  EXPECT_EQ(text_after("[ 1, 2 ]", {to_insert("/0", 0), to_insert("/3", 3)}), "[ 0, 1, 2, 3 ]");
  EXPECT_EQ(text_after("[1,2]", {to_insert("/0", 0), to_insert("/3", 3)}), "[0,1,2,3]");
  EXPECT_EQ(text_after("[1, 2, ]", {to_insert("/2", 3)}), "[1, 2, 3, ]");
  EXPECT_EQ(text_after("[1 /* one */]", {to_insert("/1", 2)}), "[1 /* one */, 2]");
  EXPECT_EQ(text_after("[/* one */ 1]", {to_insert("/0", 0)}), "[0, /* one */ 1]");
}

TEST(Edit, InsertsOnLinesOfTheirOwn) {
  const std::string text = "[\n  1, // one\n  // about two\n  2 // two\n  // end\n]\n";
  EXPECT_EQ(text_after(text, {to_insert("/0", 0)}),
            "[\n  0,\n  1, // one\n  // about two\n  2 // two\n  // end\n]\n");
  EXPECT_EQ(text_after(text, {to_insert("/1", 0)}),
            "[\n  1, // one\n  0,\n  // about two\n  2 // two\n  // end\n]\n");
  EXPECT_EQ(text_after(text, {to_insert("/2", 0)}),
            "[\n  1, // one\n  // about two\n  2, // two\n  0\n  // end\n]\n");
  EXPECT_EQ(text_after("[\r\n\t1\r\n]", {to_insert("/1", 0)}), "[\r\n\t1,\r\n\t0\r\n]");
  EXPECT_EQ(text_after("[1, 2 // two\n]", {to_insert("/2", 3)}), "[1, 2, // two\n  3\n]");
}

TEST(Edit, InsertsMembersAtTheEnd) {
  EXPECT_EQ(text_after("{ \"a\": 1 }", {to_insert("/b c", "d")}), "{ \"a\": 1, \"b c\": \"d\" }");
  EXPECT_EQ(text_after("{\"a\":1}", {to_insert("/b", {{"x", {1, 2}}})}), "{\"a\":1,\"b\":{\"x\":[1,2]}}");
  EXPECT_EQ(text_after("{\n  \"a\": 1\n}", {to_insert("/b", {{"x", {1, 2}}})}),
            "{\n  \"a\": 1,\n  \"b\": { \"x\": [1, 2] }\n}");
  EXPECT_EQ(text_after("{\n  \"a\": { \"x\": 1 },\n  \"b\": 1 }", {to_insert("/c", 1)}),
            "{\n  \"a\": { \"x\": 1 },\n  \"b\": 1,\n  \"c\": 1 }");
  EXPECT_EQ(text_after("{ \"~a/b\": {} }", {to_insert("/~0a~1b/~1", 1)}), "{ \"~a/b\": { \"/\": 1 } }");
}

TEST(Edit, InsertsIntoEmptyContainers) {
  EXPECT_EQ(text_after("[]", {to_insert("/0", 1)}), "[1]");
  EXPECT_EQ(text_after("{ }", {to_insert("/a", 1)}), "{ \"a\": 1 }");
  EXPECT_EQ(text_after("{\n  \"a\": []\n}", {to_insert("/a/0", {1, 2})}), "{\n  \"a\": [[1, 2]]\n}");
  EXPECT_EQ(text_after("{\n  \"a\": []\n}", {to_insert("/a/0", {{"x", 1}})}),
            "{\n  \"a\": [\n    { \"x\": 1 }\n  ]\n}");
  EXPECT_EQ(text_after("[ // none yet\n]", {to_insert("/0", 1)}), "[ // none yet\n  1\n]");
  EXPECT_EQ(text_after("{}", {to_insert("/a", {{"b", 1}}), to_insert("/c", 1)}),
            "{\n  \"a\": { \"b\": 1 },\n  \"c\": 1\n}");
}

TEST(Edit, FillsALineBeforeItBeginsAnother) {
  const std::string name(50, 'n');
  const std::string text = "[\n  1, \"" + name + "\"\n]";
  EXPECT_EQ(text_after(text, {to_insert("/2", name), to_insert("/3", name)}),
            "[\n  1, \"" + name + "\", \"" + name + "\",\n  \"" + name + "\"\n]");
}

TEST(Edit, BreaksALongValue) {
  const std::string name(60, 'n');
  EXPECT_EQ(text_after("{\n  \"a\": 1\n}", {to_insert("/b", {{"x", {name, name}}, {"y", 1}})}),
            "{\n  \"a\": 1,\n  \"b\": {\n    \"x\": [\n      \"" + name + "\",\n      \"" + name +
                "\"\n    ],\n    \"y\": 1\n  }\n}");
}

TEST(Edit, KeepsALongValueOnOneLineAsItsNeighbour) {
  const std::string name(150, 'n');
  EXPECT_EQ(text_after("[\n  [\"" + name + "\", 1]\n]", {to_insert("/1", {name, 2})}),
            "[\n  [\"" + name + "\", 1],\n  [\"" + name + "\", 2]\n]");
}

TEST(Edit, FillsLinesAsItsNeighbour) {
  const std::string a(50, 'a'), b(50, 'b');
  const auto member = [](const std::string& text) { return "\"" + text + "\": \"" + text + "\""; };
  const std::string begin = "{\n  \"list\": [\n    { \"x\": 1 }";
  EXPECT_EQ(
      text_after(begin + "\n  ]\n}", {to_insert("/list/1", {{a, a}, {b, b}, {"x", {{"y", 1}}}, {"z", 2}})}),
      begin + ",\n    { " + member(a) + ",\n      " + member(b) +
          ",\n      \"x\": { \"y\": 1 }, \"z\": 2 }\n  ]\n}");
  const std::string open = "{\n  \"list\": [\n    {\n      \"x\": 1\n    }";
  EXPECT_EQ(text_after(open + "\n  ]\n}", {to_insert("/list/1", {{a, a}, {b, b}})}),
            open + ",\n    {\n      " + member(a) + ",\n      " + member(b) + "\n    }\n  ]\n}");
}

TEST(Edit, RemovalTakesTheCommentsOfTheElement) {
  const std::string text =
      "[ // list\n  // group\n\n  // about one\n  // and more\n  1, // one\n  /* about\n two */\n  2, // "
      "two\n  3 // three\n  // end\n]";
  EXPECT_EQ(text_after(text, {to_remove("/0", 1)}),
            "[ // list\n  // group\n\n  /* about\n two */\n  2, // two\n  3 // three\n  // end\n]");
  EXPECT_EQ(text_after(text, {to_remove("/1", 2)}),
            "[ // list\n  // group\n\n  // about one\n  // and more\n  1, // one\n  3 // three\n  // end\n]");
  EXPECT_EQ(text_after(text, {to_remove("/2", 3)}),
            "[ // list\n  // group\n\n  // about one\n  // and more\n  1, // one\n  /* about\n two */\n  2 "
            "// two\n  // end\n]");
}

TEST(Edit, RemovalWithinALine) {
  EXPECT_EQ(text_after("[1, 2, 3]", {to_remove("/0", 1)}), "[2, 3]");
  EXPECT_EQ(text_after("[1, 2, 3]", {to_remove("/1", 2)}), "[1, 3]");
  EXPECT_EQ(text_after("[1, 2, 3]", {to_remove("/2", 3)}), "[1, 2]");
  EXPECT_EQ(text_after("[ 1, 2, ]", {to_remove("/0", 1)}), "[ 2, ]");
  EXPECT_EQ(text_after("[ 1, 2, ]", {to_remove("/1", 2)}), "[ 1, ]");
  EXPECT_EQ(text_after("{ \"a\": 1 }", {to_remove("/a", 1)}), "{}");
  EXPECT_EQ(text_after("[\n  1\n]", {to_remove("/0", 1)}), "[]");
  EXPECT_EQ(text_after("[ // list\n  1]", {to_remove("/0", 1)}), "[ // list\n  ]");
  EXPECT_EQ(text_after("[1, /* two */ 2, /* three */ 3]", {to_remove("/1", 2)}), "[1, /* three */ 3]");
  EXPECT_EQ(text_after("[1, 2 /* two */, 3 /* three */]", {to_remove("/1", 2)}), "[1, 3 /* three */]");
  EXPECT_EQ(text_after("[1 /* one */, 2 /* two */]", {to_remove("/1", 2)}), "[1 /* one */]");
}

TEST(Edit, RemovalOnASharedLineKeepsItsComment) {
  EXPECT_EQ(text_after("[\n  // both\n  1, 2, // numbers\n  3 ]", {to_remove("/0", 1)}),
            "[\n  // both\n  2, // numbers\n  3 ]");
  EXPECT_EQ(text_after("[\n  // both\n  1, 2, // numbers\n  3 ]", {to_remove("/1", 2)}),
            "[\n  // both\n  1, // numbers\n  3 ]");
}

TEST(Edit, RemovalKeepsTheBracketOutOfAComment) {
  EXPECT_EQ(text_after("[\n  1, // one\n  2 ]", {to_remove("/1", 2)}), "[\n  1 // one\n  ]");
  EXPECT_EQ(text_after("[\n  1, // one\n\n  // two\n  2 ]", {to_remove("/1", 2)}), "[\n  1 // one\n ]");
}

TEST(Edit, CommasAtTheBeginningOfLines) {
  const std::string text = "[ 1 // one\n  // about two\n, 2 // two\n, 3\n]";
  EXPECT_EQ(text_after(text, {to_remove("/0", 1)}), "[ \n  // about two\n2 // two\n, 3\n]");
  EXPECT_EQ(text_after(text, {to_remove("/2", 3)}), "[ 1 // one\n  // about two\n, 2 // two\n\n]");
}

TEST(Edit, KeepsAMarkAndForeignLineEnds) {
  EXPECT_EQ(text_after("\xEF\xBB\xBF{\r  \"a\": 1\r}\r", {to_insert("/b", 2), to_remove("/a", 1)}),
            "\xEF\xBB\xBF{\r  \"b\": 2\r}\r");
  EXPECT_EQ(text_after("\xEF\xBB\xBF\xEF\xBB\xBF[]", {to_insert("/0", 1)}), "\xEF\xBB\xBF\xEF\xBB\xBF[1]");
  EXPECT_EQ(text_after(std::string("[1]\n\0\0", 6), {to_insert("/1", 2)}), std::string("[1, 2]\n\0\0", 9));
}

TEST(Edit, AppliesOneAfterTheOther) {
  EXPECT_EQ(text_after("[1, 2]", {to_insert("/0", Json::array()), to_insert("/0/0", 5), to_remove("/2", 2),
                                  to_set("/0/0", 5, 6), to_set("/1", 1, {{"a", 1}}), to_remove("/1/a", 1)}),
            "[[6], {}]");
}

TEST(Edit, RefusesWhatDoesNotFit) {
  const auto expect_conflict = [](const std::string& text, const EditOp& op, const std::string& reason) {
    try {
      edited(text, {op});
      ADD_FAILURE() << op.path << " is accepted";
    } catch (const EditConflict& conflict) {
      EXPECT_EQ(conflict.path(), op.path);
      EXPECT_EQ(conflict.reason(), reason);
    }
  };
  const std::string text = R"({ "a": [1, 2], "b": { "c": "d" } })";
  expect_conflict(text, to_set("/a/0", 2, 3), "is 1, not 2");
  expect_conflict(text, to_set("/b", {{"c", "e"}}, 3), R"(is {"c":"d"}, not {"c":"e"})");
  expect_conflict(text, to_set("/a/2", 2, 3), "does not exist");
  expect_conflict(text, to_set("/a/00", 1, 3), "does not exist");
  expect_conflict(text, to_set("/a/-1", 1, 3), "does not exist");
  expect_conflict(text, to_set("/a/1/x", 1, 3), "does not exist");
  expect_conflict(text, to_set("/x", 1, 3), "does not exist");
  expect_conflict(text, to_remove("/x", 1), "does not exist");
  expect_conflict(text, to_remove("/a/1", 1), "is 2, not 1");
  expect_conflict(text, to_remove("", Json::parse(text)), "cannot be removed");
  expect_conflict(text, to_insert("/b/c", 1), "exists already");
  expect_conflict(text, to_insert("", 1), "exists already");
  expect_conflict(text, to_insert("/a/3", 1), "is not a place in a list of 2 elements");
  expect_conflict(text, to_insert("/a/-", 1), "is not a place in a list of 2 elements");
  expect_conflict(text, to_insert("/x/y", 1), "does not exist");
  expect_conflict(text, to_insert("/b/c/d", 1), "does not exist");
  expect_conflict(text, to_set("a", 1, 2), "is not a JSON pointer");
  expect_conflict(text, to_set("/~2", 1, 2), "is not a JSON pointer");
  expect_conflict(text, {"/a", std::nullopt, std::nullopt}, "has neither an old nor a new value");
  expect_conflict(text, to_insert("/x", "\xff"), "has a text that is not UTF-8");
  expect_conflict(text, to_insert("/x", {{"\xff", 1}}), "has a key that is not UTF-8");
  expect_conflict(text, to_insert("/\xff", 1), "has a key that is not UTF-8");
  expect_conflict(text, to_insert("/x", HUGE_VAL), "has a number that is not finite");
}

TEST(Edit, ResultStaysWithinTheLimitsOfTheParser) {
  std::string deep(max_json_levels, '[');
  deep += std::string(max_json_levels, ']');
  std::string path;
  for (std::size_t level = 1; level < max_json_levels; ++level) path += "/0";
  EXPECT_NO_THROW(edited(deep, {to_insert(path + "/0", 1)}));
  test::expect_input_error([&] { edited(deep, {to_insert(path + "/0", Json::array())}); },
                           "more than 100 nested brackets");
  Json many;
  for (int key = 0; key < 10'000; ++key) many.emplace(std::to_string(key), 0);
  test::expect_input_error([&] { edited(many.dump(), {to_insert("/one more", 1)}); }, "10,000 keys");
}

TEST(Edit, RefusesATextThatIsNotJson) {
  test::expect_input_error([] { edited("{ \"a\": 1, \"a\": 2 }", {}); }, "duplicate key");
  test::expect_input_error([] { edited("[1", {}); }, "not valid JSON");
}

}  // namespace
}  // namespace shelfbeam::serve
