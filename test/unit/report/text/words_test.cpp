#include "shelfbeam/report/text/words.hpp"

#include <nlohmann/json.hpp>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/json.hpp"

#include "support/testing.hpp"

namespace shelfbeam::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;
using Keys = std::set<std::string, std::less<>>;

const fs::path source = fs::path(SHELFBEAM_SOURCE_DIR) / "src";
const fs::path texts = source / "shelfbeam/report/text";

void collect(const nlohmann::json& node, const std::string& path, Keys& keys) {
  for (const auto& [name, value] : node.items()) {
    const std::string key = path.empty() ? name : fmt::format("{}.{}", path, name);
    if (value.is_object())
      collect(value, key, keys);
    else
      keys.insert(key);
  }
}

Keys catalogue_keys(const char* file = "english.json") {
  Keys keys;
  collect(nlohmann::json::parse(read_file(texts / file)), "", keys);
  return keys;
}

std::string_view group_of(std::string_view key) {
  return key.substr(0, key.find('.'));
}

bool is_key(std::string_view text) {
  return text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_-.{}") == std::string_view::npos;
}

// The string literals of C++ sources that can be keys. "{}" is a place that is filled at run time.
struct Literals {
  Keys all;
  Keys texts, counts;  // those in english().say("...") or english()("..."), and in english().say_count("...")

  void read(std::string_view code) {
    for (std::size_t open = code.find('"'); open != std::string_view::npos;) {
      const std::size_t close = code.find('"', open + 1);
      const std::string_view literal = code.substr(open + 1, close - open - 1);
      if (is_key(literal)) {
        all.emplace(literal);
        const std::string_view before = code.substr(0, code.find_last_not_of(" \n", open - 1) + 1);
        if (before.ends_with("say(") || before.ends_with("words(") || before.ends_with("words_("))
          texts.emplace(literal);
        if (before.ends_with("say_count(")) counts.emplace(literal);
      }
      open = close;
    }
  }
  void read_folder(const fs::path& folder) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
      if (const auto suffix = entry.path().extension(); suffix == ".cpp" || suffix == ".hpp")
        read(read_file(entry.path()));
  }
};

// The sources that show texts of the catalogue.
Literals reading_sources() {
  Literals literals;
  literals.read_folder(source / "shelfbeam/report");
  literals.read_folder(source / "app");
  return literals;
}

// Whether the pattern, whose place is filled with a number or one of the words, is the key.
bool fits(std::string_view pattern, std::string_view key, const Keys& words) {
  const std::size_t place = pattern.find("{}");
  if (place == std::string_view::npos) return pattern == key;
  const std::string_view begin = pattern.substr(0, place), end = pattern.substr(place + 2);
  if (key.size() <= begin.size() + end.size() || !key.starts_with(begin) || !key.ends_with(end)) return false;
  const std::string_view middle = key.substr(begin.size(), key.size() - begin.size() - end.size());
  return middle.find_first_not_of("0123456789") == std::string_view::npos || words.contains(middle);
}

// Keys that appear in no literal, by themselves or as the stem of a plural. `words` can fill places of
// patterns.
std::vector<std::string> unused(const Keys& keys, const Literals& literals, const Keys& words) {
  const auto is_named = [&](std::string_view key) {
    return std::any_of(literals.all.begin(), literals.all.end(),
                       [&](const std::string& pattern) { return fits(pattern, key, words); });
  };
  std::vector<std::string> found;
  for (const std::string& key : keys) {
    const std::size_t dot = key.rfind('.');
    const bool is_plural = key.ends_with(".one") || key.ends_with(".many");
    if (!is_named(key) && !(is_plural && is_named(std::string_view(key).substr(0, dot))))
      found.push_back(key);
  }
  return found;
}

bool has_plural(const Keys& keys, const std::string& stem) {
  return keys.contains(stem + ".one") && keys.contains(stem + ".many");
}

bool is_file_name(std::string_view literal) {
  constexpr std::string_view suffixes[] = {".csv", ".dxf", ".html", ".json"};
  return std::any_of(std::begin(suffixes), std::end(suffixes),
                     [&](std::string_view suffix) { return literal.ends_with(suffix); });
}

// Literals that name no text: arguments of say, words and say_count, and all others in a group of the
// catalogue.
std::vector<std::string> missing(const Keys& keys, const Literals& literals) {
  std::set<std::string> found;
  for (const std::string& literal : literals.texts)
    if (!keys.contains(literal)) found.insert(literal);
  for (const std::string& literal : literals.counts)
    if (!has_plural(keys, literal)) found.insert(literal);
  Keys groups;
  for (const std::string& key : keys) groups.emplace(group_of(key));
  for (const std::string& literal : literals.all) {
    if (literal.find('.') == std::string::npos || !groups.contains(group_of(literal))) continue;
    const std::size_t place = literal.find("{}");
    const bool exists = place == std::string::npos
                            ? keys.contains(literal) || has_plural(keys, literal) || is_file_name(literal)
                            : std::any_of(keys.begin(), keys.end(), [&](const std::string& key) {
                                return key.starts_with(std::string_view(literal).substr(0, place));
                              });
    if (!exists) found.insert(literal);
  }
  return {found.begin(), found.end()};
}

TEST(TextCatalogue, NamesEachTextOnce) {
  for (const char* file : {"english.json", "german.json"})
    EXPECT_NO_THROW(JsonCursor::parse_file(texts / file));
}

TEST(TextCatalogue, HasAllTextsOfTheSources) {
  const Keys keys = catalogue_keys();
  Literals literals = reading_sources();
  EXPECT_GT(literals.texts.size(), 100U);
  EXPECT_THAT(missing(keys, literals), IsEmpty());

  literals.read(
      R"code(english().say("facts.none_1"); words("none_2.title"); english().say_count("facts.title", 3);)code");
  literals.read(R"code(text_of("facts.none_3"); english().say(fmt::format("facts.none_4.{}", name));)code");
  EXPECT_THAT(missing(keys, literals),
              ElementsAre("facts.none_1", "facts.none_3", "facts.none_4.{}", "facts.title", "none_2.title"));
}

// test/system/viewer checks the texts of the 3-D view.
TEST(TextCatalogue, HasNoTextThatIsNotUsed) {
  Keys keys = catalogue_keys();
  std::erase_if(keys, [](const std::string& key) { return group_of(key) == "viewer"; });
  const Literals literals = reading_sources();
  Literals names;  // of enumerators
  names.read_folder(source / "shelfbeam");
  EXPECT_THAT(unused(keys, literals, names.all), IsEmpty());

  keys.insert({"facts.nothing", "proof.method.none_1"});
  EXPECT_THAT(unused(keys, literals, names.all), ElementsAre("facts.nothing", "proof.method.none_1"));
}

TEST(TextCatalogue, FillsPlaces) {
  const Words words = english();
  EXPECT_EQ(words("facts.part"), "{0} of {1}");
  EXPECT_EQ(words.say("facts.part", 3, "12"), "3 of 12");
  EXPECT_EQ(words.say_count("noun.label", 1), "1 label");
  EXPECT_EQ(words.say_count("noun.label", 1200), "1,200 labels");
}

TEST(TextCatalogue, RejectsUnknownKeys) {
  for (const char* key : {"facts.nothing", "facts", "", "facts.part."})
    EXPECT_THROW(english()(key), std::logic_error);
  EXPECT_THROW(english().say_count("facts.title", 2), std::logic_error);
}

// The places of a text, with their formats: "{0}", "{1:.2f}".
std::multiset<std::string> places_of(std::string_view text) {
  std::multiset<std::string> places;
  for (std::size_t open = 0; (open = text.find('{', open)) != std::string_view::npos; ++open)
    places.emplace(text.substr(open, text.find('}', open) - open + 1));
  return places;
}

TEST(TextCatalogue, HasTheSamePlacesInEachLanguage) {
  const Words german(Language::german);
  EXPECT_EQ(catalogue_keys("german.json"), catalogue_keys());
  for (const std::string& key : catalogue_keys())
    EXPECT_EQ(places_of(german(key)), places_of(english()(key))) << key;
  EXPECT_NE(places_of("{0} of {1}"), places_of("{1} von {1}")) << "the control";
}

TEST(TextCatalogue, WritesNumbersAsTheLanguageDoes) {
  const Words german(Language::german);
  EXPECT_EQ(german.grouped(1234567), "1.234.567");
  EXPECT_EQ(german.fixed(-1.25, 2), "−1,25");
  EXPECT_EQ(german.significant(1.234e-7), "1,23·10^-7");
  EXPECT_EQ(german.plain(2.5), "2,5");
  EXPECT_EQ(german.plain_down(123.45678), "123,456");
  EXPECT_EQ(german.percent(0.166), "16,6\u00A0%");
  EXPECT_EQ(german.decibels(3.164, 2), "+3,16\u00A0dB");
  EXPECT_EQ(german.say_count("noun.label", 1200), "1.200 Etiketten");
}

}  // namespace
}  // namespace shelfbeam::test
