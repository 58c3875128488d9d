// Tests edits and their parts: values, texts of scalars, splices, and the gaps between tokens.

#include "serve/text/edit.hpp"

#include <cstring>

#include "serve/text/gap.hpp"
#include "serve/text/json_value.hpp"
#include "serve/text/splice.hpp"
#include "unit/serve/testing.hpp"

namespace shelfbeam::serve {
namespace {

using Ops = std::vector<EditOp>;

void expect_edit(const std::string& before, const Ops& ops, const std::string& after) {
  const EditedText result = edited(before, ops);
  EXPECT_EQ(result.text, after) << "from " << before;
  EXPECT_EQ(spliced(result.text, inverse(result.splices)), before) << "does not lead back";
}

TEST(Edit, SetChangesOnlyTheBytesOfTheValue) {
  expect_edit("{ \"at\": [5, 4.60], // metres\n  \"b\" :1}", {to_set("/at/0", 5, 5.25)},
              "{ \"at\": [5.25, 4.60], // metres\n  \"b\" :1}");
  expect_edit("{ \"a\": \"b\" }", {to_set("/a", "b", {1, 2})}, "{ \"a\": [1, 2] }");
  expect_edit("// c\n1 // d", {to_set("", 1, Json::object())}, "// c\n{} // d");
}

TEST(Edit, AnEqualValueChangesNoByte) {
  const std::string text = "{ \"a\": [1.0, 2e0], \"b\": { \"x\": 1, \"y\": 2 } }";
  expect_edit(text, {to_set("/a", {1, 2}, {1.0, 2})}, text);
  expect_edit(text, {to_set("/b", {{"y", 2}, {"x", 1.0}}, {{"y", 2}, {"x", 1}})}, text);
}

TEST(Edit, SetKeepsEqualPartsOfAList) {
  expect_edit("[ [1, 2], /* b */ [3, 4] ]", {to_set("", {{1, 2}, {3, 4}}, {{1, 2}, {3, 5}})},
              "[ [1, 2], /* b */ [3, 5] ]");
  expect_edit("[1.0, /* two */ 2.0, 3.0]", {to_set("", {1, 2, 3}, {1, 3})}, "[1.0, 3.0]");
  expect_edit("[1.0, /* three */ 3.0]", {to_set("", {1, 3}, {0, 1, 2, 3})}, "[0, 1, 2, /* three */ 3.0]");
  expect_edit("[1.0, 4.0]", {to_set("", {1, 4}, {1, 2, 3, 4})}, "[1.0, 2, 3, 4.0]");
}

TEST(Edit, SetKeepsEqualMembersOfAnObject) {
  expect_edit("{ \"a\": 1.0, // one\n  \"b\": 2 // two\n}",
              {to_set("", {{"a", 1}, {"b", 2}}, {{"c", 3}, {"a", 1}})},
              "{ \"a\": 1.0, // one\n  \"c\": 3\n}");
}

TEST(Edit, InsertsIntoLists) {
  expect_edit("[1, 2]", {to_insert("/0", 0)}, "[0, 1, 2]");
  expect_edit("[1, 2]", {to_insert("/1", 0)}, "[1, 0, 2]");
  expect_edit("[1, 2]", {to_insert("/2", 0)}, "[1, 2, 0]");
  expect_edit("[ 1, 2 ]", {to_insert("/0", 0), to_insert("/3", 3)}, "[ 0, 1, 2, 3 ]");
  expect_edit("[1,2]", {to_insert("/0", 0), to_insert("/3", 3)}, "[0,1,2,3]");
  expect_edit("[1, 2, ]", {to_insert("/2", 3)}, "[1, 2, 3, ]");
  expect_edit("[1 /* one */]", {to_insert("/1", 2)}, "[1 /* one */, 2]");
  expect_edit("[/* one */ 1]", {to_insert("/0", 0)}, "[0, /* one */ 1]");
}

TEST(Edit, InsertsOnLinesOfTheirOwn) {
  const std::string text = "[\n  1, // one\n  // about two\n  2 // two\n  // end\n]\n";
  expect_edit(text, {to_insert("/0", 0)}, "[\n  0,\n  1, // one\n  // about two\n  2 // two\n  // end\n]\n");
  expect_edit(text, {to_insert("/1", 0)}, "[\n  1, // one\n  0,\n  // about two\n  2 // two\n  // end\n]\n");
  expect_edit(text, {to_insert("/2", 0)}, "[\n  1, // one\n  // about two\n  2, // two\n  0\n  // end\n]\n");
  expect_edit("[\r\n\t1\r\n]", {to_insert("/1", 0)}, "[\r\n\t1,\r\n\t0\r\n]");
  expect_edit("[1, 2 // two\n]", {to_insert("/2", 3)}, "[1, 2, // two\n  3\n]");
}

TEST(Edit, InsertsMembersAtTheEnd) {
  expect_edit("{ \"a\": 1 }", {to_insert("/b c", "d")}, "{ \"a\": 1, \"b c\": \"d\" }");
  expect_edit("{\"a\":1}", {to_insert("/b", {{"x", {1, 2}}})}, "{\"a\":1,\"b\":{\"x\":[1,2]}}");
  expect_edit("{\n  \"a\": 1\n}", {to_insert("/b", {{"x", {1, 2}}})},
              "{\n  \"a\": 1,\n  \"b\": { \"x\": [1, 2] }\n}");
  expect_edit("{\n  \"a\": { \"x\": 1 },\n  \"b\": 1 }", {to_insert("/c", 1)},
              "{\n  \"a\": { \"x\": 1 },\n  \"b\": 1,\n  \"c\": 1 }");
  expect_edit("{ \"~a/b\": {} }", {to_insert("/~0a~1b/~1", 1)}, "{ \"~a/b\": { \"/\": 1 } }");
}

TEST(Edit, InsertsIntoEmptyContainers) {
  expect_edit("[]", {to_insert("/0", 1)}, "[1]");
  expect_edit("{ }", {to_insert("/a", 1)}, "{ \"a\": 1 }");
  expect_edit("{\n  \"a\": []\n}", {to_insert("/a/0", {1, 2})}, "{\n  \"a\": [[1, 2]]\n}");
  expect_edit("{\n  \"a\": []\n}", {to_insert("/a/0", {{"x", 1}})},
              "{\n  \"a\": [\n    { \"x\": 1 }\n  ]\n}");
  expect_edit("[ // none yet\n]", {to_insert("/0", 1)}, "[ // none yet\n  1\n]");
  expect_edit("{}", {to_insert("/a", {{"b", 1}}), to_insert("/c", 1)},
              "{\n  \"a\": { \"b\": 1 },\n  \"c\": 1\n}");
}

TEST(Edit, FillsALineBeforeItBeginsAnother) {
  const std::string name(50, 'n');
  const std::string text = "[\n  1, \"" + name + "\"\n]";
  expect_edit(text, {to_insert("/2", name), to_insert("/3", name)},
              "[\n  1, \"" + name + "\", \"" + name + "\",\n  \"" + name + "\"\n]");
}

TEST(Edit, BreaksALongValue) {
  const std::string name(60, 'n');
  expect_edit("{\n  \"a\": 1\n}", {to_insert("/b", {{"x", {name, name}}, {"y", 1}})},
              "{\n  \"a\": 1,\n  \"b\": {\n    \"x\": [\n      \"" + name + "\",\n      \"" + name +
                  "\"\n    ],\n    \"y\": 1\n  }\n}");
}

TEST(Edit, KeepsALongValueOnOneLineAsItsNeighbour) {
  const std::string name(150, 'n');
  expect_edit("[\n  [\"" + name + "\", 1]\n]", {to_insert("/1", {name, 2})},
              "[\n  [\"" + name + "\", 1],\n  [\"" + name + "\", 2]\n]");
}

TEST(Edit, FillsLinesAsItsNeighbour) {
  const std::string a(50, 'a'), b(50, 'b');
  const auto member = [](const std::string& text) { return "\"" + text + "\": \"" + text + "\""; };
  const std::string begin = "{\n  \"list\": [\n    { \"x\": 1 }";
  expect_edit(begin + "\n  ]\n}", {to_insert("/list/1", {{a, a}, {b, b}, {"x", {{"y", 1}}}, {"z", 2}})},
              begin + ",\n    { " + member(a) + ",\n      " + member(b) +
                  ",\n      \"x\": { \"y\": 1 }, \"z\": 2 }\n  ]\n}");
  const std::string open = "{\n  \"list\": [\n    {\n      \"x\": 1\n    }";
  expect_edit(open + "\n  ]\n}", {to_insert("/list/1", {{a, a}, {b, b}})},
              open + ",\n    {\n      " + member(a) + ",\n      " + member(b) + "\n    }\n  ]\n}");
}

TEST(Edit, RemovalTakesTheCommentsOfTheElement) {
  const std::string text =
      "[ // list\n  // group\n\n  // about one\n  // and more\n  1, // one\n  /* about\n two */\n  2, // "
      "two\n  3 // three\n  // end\n]";
  expect_edit(text, {to_remove("/0", 1)},
              "[ // list\n  // group\n\n  /* about\n two */\n  2, // two\n  3 // three\n  // end\n]");
  expect_edit(
      text, {to_remove("/1", 2)},
      "[ // list\n  // group\n\n  // about one\n  // and more\n  1, // one\n  3 // three\n  // end\n]");
  expect_edit(text, {to_remove("/2", 3)},
              "[ // list\n  // group\n\n  // about one\n  // and more\n  1, // one\n  /* about\n two */\n  2 "
              "// two\n  // end\n]");
}

TEST(Edit, RemovalWithinALine) {
  expect_edit("[1, 2, 3]", {to_remove("/0", 1)}, "[2, 3]");
  expect_edit("[1, 2, 3]", {to_remove("/1", 2)}, "[1, 3]");
  expect_edit("[1, 2, 3]", {to_remove("/2", 3)}, "[1, 2]");
  expect_edit("[ 1, 2, ]", {to_remove("/0", 1)}, "[ 2, ]");
  expect_edit("[ 1, 2, ]", {to_remove("/1", 2)}, "[ 1, ]");
  expect_edit("{ \"a\": 1 }", {to_remove("/a", 1)}, "{}");
  expect_edit("[\n  1\n]", {to_remove("/0", 1)}, "[]");
  expect_edit("[ // list\n  1]", {to_remove("/0", 1)}, "[ // list\n  ]");
  expect_edit("[1, /* two */ 2, /* three */ 3]", {to_remove("/1", 2)}, "[1, /* three */ 3]");
  expect_edit("[1, 2 /* two */, 3 /* three */]", {to_remove("/1", 2)}, "[1, 3 /* three */]");
  expect_edit("[1 /* one */, 2 /* two */]", {to_remove("/1", 2)}, "[1 /* one */]");
}

TEST(Edit, RemovalOnASharedLineKeepsItsComment) {
  expect_edit("[\n  // both\n  1, 2, // numbers\n  3 ]", {to_remove("/0", 1)},
              "[\n  // both\n  2, // numbers\n  3 ]");
  expect_edit("[\n  // both\n  1, 2, // numbers\n  3 ]", {to_remove("/1", 2)},
              "[\n  // both\n  1, // numbers\n  3 ]");
}

TEST(Edit, RemovalKeepsTheBracketOutOfAComment) {
  expect_edit("[\n  1, // one\n  2 ]", {to_remove("/1", 2)}, "[\n  1 // one\n  ]");
  expect_edit("[\n  1, // one\n\n  // two\n  2 ]", {to_remove("/1", 2)}, "[\n  1 // one\n ]");
}

TEST(Edit, CommasAtTheBeginningOfLines) {
  const std::string text = "[ 1 // one\n  // about two\n, 2 // two\n, 3\n]";
  expect_edit(text, {to_remove("/0", 1)}, "[ \n  // about two\n2 // two\n, 3\n]");
  expect_edit(text, {to_remove("/2", 3)}, "[ 1 // one\n  // about two\n, 2 // two\n\n]");
}

TEST(Edit, KeepsAMarkAndForeignLineEnds) {
  expect_edit("\xEF\xBB\xBF{\r  \"a\": 1\r}\r", {to_insert("/b", 2), to_remove("/a", 1)},
              "\xEF\xBB\xBF{\r  \"b\": 2\r}\r");
  expect_edit("\xEF\xBB\xBF\xEF\xBB\xBF[]", {to_insert("/0", 1)}, "\xEF\xBB\xBF\xEF\xBB\xBF[1]");
  expect_edit(std::string("[1]\n\0\0", 6), {to_insert("/1", 2)}, std::string("[1, 2]\n\0\0", 9));
}

TEST(Edit, AppliesOneAfterTheOther) {
  expect_edit("[1, 2]",
              {to_insert("/0", Json::array()), to_insert("/0/0", 5), to_remove("/2", 2), to_set("/0/0", 5, 6),
               to_set("/1", 1, {{"a", 1}}), to_remove("/1/a", 1)},
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
  expect_input_error([&] { edited(deep, {to_insert(path + "/0", Json::array())}); },
                     "more than 100 nested brackets");
  Json many;
  for (int key = 0; key < 10'000; ++key) many.emplace(std::to_string(key), 0);
  expect_input_error([&] { edited(many.dump(), {to_insert("/one more", 1)}); }, "10,000 keys");
}

TEST(Edit, RefusesATextThatIsNotJson) {
  expect_input_error([] { edited("{ \"a\": 1, \"a\": 2 }", {}); }, "duplicate key");
  expect_input_error([] { edited("[1", {}); }, "not valid JSON");
}

TEST(JsonValue, EqualsAsJson) {
  EXPECT_TRUE(same_value(1, 1.0));
  EXPECT_TRUE(same_value(1u, 1));
  EXPECT_TRUE(same_value({{"a", 1}, {"b", {2}}}, {{"b", {2.0}}, {"a", 1}}));
  EXPECT_TRUE(same_value(Json::array(), Json::array()));
  EXPECT_FALSE(same_value({1, 2}, {2, 1}));
  EXPECT_FALSE(same_value({{"a", 1}}, {{"b", 1}}));
  EXPECT_FALSE(same_value({{"a", 1}}, {{"a", 1}, {"b", 1}}));
  EXPECT_FALSE(same_value(1, "1"));
  EXPECT_FALSE(same_value(0, false));
  EXPECT_FALSE(same_value(nullptr, false));
  EXPECT_FALSE(same_value(Json::array(), Json::object()));
  EXPECT_FALSE(same_value(std::numeric_limits<std::uint64_t>::max(), -1)) << "the same bits";
}

TEST(JsonValue, NumbersAreShort) {
  const std::pair<double, const char*> cases[] = {{0, "0"},           {-0.0, "0"},
                                                  {1, "1"},           {0.1, "0.1"},
                                                  {-12.5, "-12.5"},   {1e5, "100000"},
                                                  {1e20, "1e20"},     {2.5e-7, "2.5e-7"},
                                                  {1e300, "1e300"},   {0.000125, "0.000125"},
                                                  {5e-324, "5e-324"}, {0.1 + 0.2, "0.30000000000000004"}};
  for (const auto& [value, text] : cases) EXPECT_EQ(scalar_text(value), text);
  EXPECT_EQ(scalar_text(std::numeric_limits<std::int64_t>::min()), "-9223372036854775808");
}

TEST(JsonValue, NumbersReadBackExactly) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20'000; ++i) {
    const std::uint64_t bits = random();
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    const double centimetres = static_cast<double>(bits % 100'000) / 100;
    for (const double number : {value, centimetres})
      ASSERT_EQ(parse_json(scalar_text(number), "number").get<double>(), number) << scalar_text(number);
  }
}

TEST(Splice, IsTheShortestReplacement) {
  EXPECT_EQ(splice_between("one two three", "one 2 three"), (Splice{4, "two", "2"}));
  EXPECT_EQ(splice_between("aa", "aaa"), (Splice{2, "", "a"}));
  EXPECT_EQ(splice_between("same", "same"), (Splice{4, "", ""}));
  EXPECT_EQ(splice_between("", "new"), (Splice{0, "", "new"}));
  EXPECT_EQ(splice_between("old", ""), (Splice{0, "old", ""}));
}

TEST(Splice, TurnsOneTextIntoTheOther) {
  for (const auto& [before, after] : {std::pair{"abcabc", "abc"}, {"abab", "ababab"}, {"x", "y"}, {"", ""}})
    EXPECT_EQ(spliced(before, splice_between(before, after)), after);
}

TEST(Splice, SeveralApplyAtOnceAndBack) {
  const std::vector<Splice> splices{{0, "one", "1"}, {4, "", "and "}, {8, "three", "three hundred"}};
  EXPECT_EQ(spliced("one two three", splices), "1 and two three hundred");
  EXPECT_EQ(spliced("1 and two three hundred", inverse(splices)), "one two three");
  EXPECT_EQ(inverse(inverse(splices)), splices);
}

TEST(Splice, RefusesAnotherText) {
  const auto apply_to_one = [](const std::vector<Splice>& splices) { return spliced("one", splices); };
  EXPECT_THROW(apply_to_one({{0, "two", ""}}), std::invalid_argument);
  EXPECT_THROW(apply_to_one({{2, "ee", ""}}), std::invalid_argument);
  EXPECT_THROW(apply_to_one({{4, "", "x"}}), std::invalid_argument);
  EXPECT_THROW(apply_to_one({{1, "n", ""}, {0, "o", ""}}), std::invalid_argument);
}

std::string kinds(std::string_view gap) {
  std::string kinds;
  for (const GapPart& part : parts_of(gap)) kinds += "-n/*"[static_cast<int>(part.kind)];
  return kinds;
}

TEST(Gap, HasParts) {
  EXPECT_EQ(kinds(""), "");
  EXPECT_EQ(kinds(" \t// a \" /* \r\n/* b\n // */ \r\r\n\n/**/"), "-/n*-nnn*");
  EXPECT_EQ(kinds("/*/ a"), "*") << "not closed";
  EXPECT_EQ(gap_end(" /* a */// b\n x", 0), 14u);
  EXPECT_EQ(gap_end("/x", 0), 0u) << "not a comment";
}

TEST(Gap, FirstLineEndsOutsideOfComments) {
  EXPECT_EQ(first_line(" // a\n  "), " // a");
  EXPECT_EQ(first_line(" /* a\n b */ \r\n  "), " /* a\n b */ ");
  EXPECT_EQ(first_line("  "), "  ");
  EXPECT_FALSE(has_line_end("/*\n*/"));
  EXPECT_TRUE(has_line_end("\r"));
}

TEST(Gap, OwnLinesAreTheLastAndTheCommentsAboveIt) {
  const auto lines = [](std::string_view gap) { return std::string(gap.substr(own_lines(gap))); };
  EXPECT_EQ(lines(" // of the line\n  "), "\n  ");
  EXPECT_EQ(lines(" // of the line\n  // a\n  // b\n  "), "\n  // a\n  // b\n  ");
  EXPECT_EQ(lines("\n  // a\n\n  // b\n  "), "\n  // b\n  ");
  EXPECT_EQ(lines("\n  // a\n \n  /* b */ "), "\n  /* b */ ");
  EXPECT_EQ(lines("\r\n/* a\n b */\r\n\t"), "\r\n/* a\n b */\r\n\t");
  EXPECT_EQ(indentation("\n  // a\n\t /* b\n */ "), "\t ");
}

}  // namespace
}  // namespace shelfbeam::serve
