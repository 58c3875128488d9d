#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/report/data/report.hpp"

#include "unit/report/supermarket_report.hpp"

namespace shelfbeam {
namespace {

using test::Supermarket;
using testing::IsEmpty;

// The pieces of a catalogue's texts between their places. Pieces too short to belong to one language are left
// out.
void collect_pieces(const nlohmann::json& node, std::set<std::string>& pieces) {
  constexpr std::size_t shortest = 9;
  if (!node.is_string()) {
    for (const nlohmann::json& value : node) collect_pieces(value, pieces);
    return;
  }
  const auto text = node.get<std::string>();
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('{', begin), text.size());
    if (end - begin >= shortest) pieces.insert(text.substr(begin, end - begin));
    begin = std::min(text.find('}', end), text.size()) + 1;
  }
}

std::set<std::string> pieces_of(const char* file) {
  std::set<std::string> pieces;
  auto catalogue = nlohmann::json::parse(
      read_file(std::string(SHELFBEAM_SOURCE_DIR "/src/shelfbeam/report/text/") + file));
  catalogue.erase("viewer");
  collect_pieces(catalogue, pieces);
  return pieces;
}

// The English pieces in a text that occur in no German one.
std::vector<std::string> english_in(const std::string& text) {
  static const std::set<std::string> english = pieces_of("english.json"), german = pieces_of("german.json");
  std::vector<std::string> found;
  const auto is_german = [&](const std::string& piece) {
    return std::any_of(german.begin(), german.end(),
                       [&](const std::string& one) { return one.find(piece) != std::string::npos; });
  };
  for (const std::string& piece : english)
    if (text.find(piece) != std::string::npos && !is_german(piece)) found.push_back(piece);
  return found;
}

// The columns of a table have the same names in all languages.
std::string without_header(const std::string& csv) {
  return csv.substr(csv.find('\n'));
}

std::string text_of(const ReportInput& input) {
  return test::read_markup(test::static_report(input)).text;
}

TEST(LanguageOfReport, IsThatOfTheStore) {
  Supermarket s;
  test::certify(s);
  EXPECT_GT(english_in(text_of(s.input)).size(), 50U) << "the control";
  s.scene.language = Language::german;
  const std::string html = report_html(s.input);
  EXPECT_THAT(english_in(text_of(s.input)), IsEmpty());
  EXPECT_THAT(english_in(floor_plan_svg(s.scene)), IsEmpty());
  EXPECT_THAT(english_in(without_header(mounting_csv(s.input))), IsEmpty());
  EXPECT_THAT(english_in(mounting_dxf(s.input)), IsEmpty());
  EXPECT_NE(html.find("<html lang=\"de\">"), std::string::npos);
  EXPECT_NE(html.find("\"Schließen\""), std::string::npos) << "the texts of the 3-D view";
}

// A comma instead of a point in a coordinate would change a drawing.
TEST(LanguageOfReport, DoesNotChangeDrawings) {
  Supermarket s;
  const auto geometry = [&] {
    std::vector<std::string> values;
    for (const auto& element : test::read_markup(test::static_report(s.input)).elements)
      for (const auto& [name, value] : element.attributes)
        if (name == "d" || name == "x" || name == "y" || name == "points" || name == "transform" ||
            name == "viewBox" || name == "style")
          values.push_back(value);
    return values;
  };
  const std::vector<std::string> english = geometry();
  s.scene.language = Language::german;
  EXPECT_GT(english.size(), 100U);
  EXPECT_EQ(geometry(), english);
}

}  // namespace
}  // namespace shelfbeam
