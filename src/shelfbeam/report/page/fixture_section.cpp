#include <algorithm>
#include <map>
#include <unordered_map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/report/page/html.hpp"
#include "shelfbeam/report/page/sections.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

struct Reached {
  std::size_t reached = 0, all = 0;

  void add(bool is_reached) {
    ++all;
    reached += is_reached ? 1 : 0;
  }
};

struct FixtureLabels {
  Reached labels;
  std::map<int, Reached> boards;
  LabelId weakest;  ///< a row
};

std::string part_of(const Words& words, const Reached& count) {
  return words.say("facts.part", words.grouped(count.reached), words.grouped(count.all));
}

std::string boards_of(const Words& words, const FixtureLabels& fixture) {
  if (fixture.boards.size() == 1 && fixture.boards.begin()->first == 0) return "–";
  std::vector<std::string> parts;
  for (const auto& [board, count] : fixture.boards)
    parts.push_back(count.reached == count.all ? words.grouped(count.all) : part_of(words, count));
  return fmt::format("{}", fmt::join(parts, " · "));
}

}  // namespace

std::string fixture_section(const ReportData& data) {
  if (!data.has_selection()) return {};
  std::vector<std::pair<std::string, FixtureLabels>> fixtures;  // in the order of the labels
  std::unordered_map<std::string_view, std::size_t> known;
  for (std::uint32_t row = 0; row < data.outcome.labels.size(); ++row) {
    const auto [found, is_new] = known.emplace(data.names.fixture(row), fixtures.size());
    if (is_new) fixtures.emplace_back(data.names.fixture(row), FixtureLabels{});
    FixtureLabels& fixture = fixtures[found->second].second;
    if (is_new) fixture.weakest = row;
    fixture.labels.add(data.is_reached(row));
    fixture.boards[data.names.board(row)].add(data.is_reached(row));
    if (data.outcome.labels[row].margin() < data.outcome.labels[fixture.weakest].margin())
      fixture.weakest = row;
  }
  HtmlTable table({{data.words.say("label.fixtures.fixture"), false},
                   {data.words.say("label.fixtures.reached")},
                   {data.words.say("label.fixtures.boards"), false, true},
                   {data.words.say("label.fixtures.margin")},
                   {data.words.say("label.fixtures.weakest"), false, true}});
  for (const auto& [name, fixture] : fixtures)
    table.add_row({name, part_of(data.words, fixture.labels), boards_of(data.words, fixture),
                   data.words.decibels(data.outcome.labels[fixture.weakest].margin()),
                   data.names.name(fixture.weakest)});
  return html_section("fixtures", data.words.say("label.fixtures.title"), table.html());
}

}  // namespace shelfbeam
