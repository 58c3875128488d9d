#include "shelfbeam/report/data/label_names.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace shelfbeam {

namespace {

std::string wall_name(const Words& words, const Scene& scene, std::size_t wall) {
  const auto [x, y] = scene.room->wall(wall).inward;
  const char* const key = std::abs(x) > std::abs(y) ? (x > 0 ? "left" : "right") : (y > 0 ? "bottom" : "top");
  return words.say("mounting.wall", words(fmt::format("mounting.side.{}", key)));
}

std::string fixture_of(const Words& words, const Scene& scene, const LabelPlace& place) {
  if (!place.fixture.empty()) return place.fixture;
  return place.wall && scene.room ? wall_name(words, scene, *place.wall) : words.say("label.elsewhere");
}

// Fixtures with labels on several faces, where a place without its face would be ambiguous.
std::set<std::string_view> with_several_faces(const Scene& scene) {
  std::map<std::string_view, std::set<Face>> faces;
  for (const Label& label : scene.labels)
    if (label.place.face) faces[label.place.fixture].insert(*label.place.face);
  std::set<std::string_view> several;
  for (const auto& [fixture, of] : faces)
    if (of.size() > 1) several.insert(fixture);
  return several;
}

bool is_article_number(std::string_view id) {
  return std::all_of(id.begin(), id.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::string name_of_label(const Words& words, const Label& label, const std::string& place) {
  if (!label.description.empty())
    return place.empty() ? label.description : words.say("label.named", label.description, place);
  if (label.place.board > 0 && label.place.face)
    return words.say("label.along", place, words.fixed(label.place.along, 2));
  if (place.empty() && !is_article_number(label.id)) return label.id;
  const auto [x, y, z] = label.position;
  return words.say("label.at", place.empty() ? words("label.label") : place, words.fixed(x, 2),
                   words.fixed(y, 2), words.fixed(z, 2));
}

}  // namespace

LabelNames::LabelNames(const Scene& scene, const SignalMatrix& matrix, const Words& words) : words_(words) {
  const std::set<std::string_view> several_faces = with_several_faces(scene);
  std::unordered_map<std::string_view, const Label*> labels;
  for (const Label& label : scene.labels) labels.emplace(label.id, &label);
  for (const LabelRow& row : matrix.labels) {
    const auto found = labels.find(row.id);
    Label label;
    label.id = row.id;
    label.position = row.position;
    if (found != labels.end()) label = *found->second;
    const LabelPlace& at = label.place;
    const std::string fixture = fixture_of(words, scene, at);
    std::string place;
    if (at.is_known()) {
      place = fixture;
      if (at.on_top)
        place = words.say("label.on_top", place);
      else if (at.face && several_faces.contains(at.fixture))
        place = words.say("label.face", place, words(fmt::format("label.faces.{}", to_text(*at.face))));
      if (at.board > 0) place = words.say("label.board", place, at.board);
    }
    names_.push_back(name_of_label(words, label, place));
    fixtures_.push_back(fixture);
    boards_.push_back(at.board);
  }
  for (const std::string& fixture : fixtures_) ++labels_on_[fixture];
}

std::vector<std::pair<std::string, std::size_t>> LabelNames::per_fixture(
    std::span<const LabelId> rows) const {
  std::vector<LabelId> sorted(rows.begin(), rows.end());
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::pair<std::string, std::size_t>> counts;
  std::unordered_map<std::string_view, std::size_t> known;
  for (const LabelId row : sorted) {
    const auto [found, is_new] = known.emplace(fixtures_[row], counts.size());
    if (is_new) counts.emplace_back(fixtures_[row], 0);
    ++counts[found->second].second;
  }
  return counts;
}

std::vector<std::string> LabelNames::counts(std::span<const LabelId> rows) const {
  std::vector<std::string> texts;
  for (const auto& [fixture, count] : per_fixture(rows))
    texts.push_back(
        words_.say("label.count", fixture, words_.grouped(count), words_.grouped(labels_on_.at(fixture))));
  return texts;
}

std::string LabelNames::list(std::span<const LabelId> rows) const {
  constexpr std::size_t max_names = 4, max_fixtures = 4;
  std::vector<std::string> parts;
  if (rows.size() <= max_names) {
    for (const LabelId row : rows) parts.push_back(names_[row]);
    return fmt::format("{}", fmt::join(parts, "; "));
  }
  const auto counts = per_fixture(rows);
  for (std::size_t k = 0; k < std::min(counts.size(), max_fixtures); ++k)
    parts.push_back(words_.say("label.on_fixture", counts[k].first, words_.grouped(counts[k].second)));
  const std::string text = fmt::format("{}", fmt::join(parts, ", "));
  return counts.size() > max_fixtures ? words_.say("summary.and_others", text) : text;
}

}  // namespace shelfbeam
