#include "shelfbeam/scene/planogram/fixture_places.hpp"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/store/store_parts.hpp"

namespace shelfbeam {

namespace {

void read_face(const CsvReader& csv, std::size_t field, const LabelSides& sides, PlanogramPlace& place) {
  const std::string name = lower_case(csv.text(field));
  if (sides.top && name == top_face) return;
  place.face = from_text<Face>(name);
  if (!place.face || !sides.has(place.face))
    csv.fail(field, fmt::format("is {}", in_quotes(csv.text(field))),
             fmt::format("use a face of the fixture: {}", known_faces(sides)));
}

}  // namespace

FixturePlaces::FixturePlaces(const ArticleLabels& labels, const FixtureColumns& columns,
                             const StoreNames& names, const Store& store, const Problems& problems)
    : labels_(labels), columns_(columns), names_(names), store_(store), problems_(problems) {
  for (std::size_t f = 0; f < store.fixtures.size(); ++f) index_.emplace(id_of(store.fixtures[f].value), f);
}

std::size_t FixturePlaces::add(CsvReader& csv) {
  const PlanogramRecord record(csv, columns_, names_, store_.unit);
  PlanogramPlace place = record.begin();
  const std::string id = csv.text(columns_.fixture);
  const auto found = index_.find(id);
  if (found == index_.end()) {
    expect_fixtures(problems_, id);
    csv.fail(columns_.fixture, fmt::format("names the unknown fixture {}", in_quotes(id)),
             id.empty() ? "name it, or set 'fill_down' of 'planogram' if cells were merged"
                        : id_remedy(id, "correct the id, or add the fixture to the store"));
  }
  place.fixture = found->second;
  record.read_type(place.style);
  const auto sides = label_sides(store_.fixtures[place.fixture].value);
  if (!sides || sides->heights.empty())
    csv.fail(columns_.fixture, "names a fixture without boards", fmt::format("use {}", types_with_sides));
  read_face(csv, columns_.face, *sides, place);
  const auto boards = static_cast<int>(sides->levels(place.face));
  const auto lowest = static_cast<int>(labels_.first_level);
  const int level = record.whole(columns_.level, lowest, lowest + boards - 1, ", or correct 'first_level'");
  place.level = labels_.from_top ? boards - (level - lowest) : level - lowest + 1;
  int position = 0;
  if (columns_.by_x) {
    place.along = record.distance(columns_.place, sides->length(place.face), "edge");
  } else {
    constexpr int max_positions = 1000;
    const auto first = static_cast<int>(labels_.first_position);
    position = record.whole(columns_.place, first, max_positions, ", or set 'first_position'") - first + 1;
  }
  if (!place.face && has_value(csv, columns_.y))
    place.across = record.distance(*columns_.y, sides->footing.depth, "top");
  record.read_mounting(place.style, !place.face);
  places_.push_back(std::move(place));
  positions_.push_back(position);
  return 1;
}

std::vector<PlanogramPlace> FixturePlaces::finish() {
  std::map<std::tuple<std::size_t, std::optional<Face>, int>, int> largest;
  const auto count_on = [&](const PlanogramPlace& place) -> int& {
    return largest[{place.fixture, place.face, place.level}];
  };
  for (std::size_t k = 0; k < places_.size(); ++k) {
    int& count = count_on(places_[k]);
    count = std::max(count, positions_[k]);
  }
  for (std::size_t k = 0; k < places_.size(); ++k)
    if (PlanogramPlace& place = places_[k]; positions_[k] > 0)
      place.along = label_sides(store_.fixtures[place.fixture].value)->length(place.face) *
                    (positions_[k] - 0.5) / count_on(place);
  return std::move(places_);
}

}  // namespace shelfbeam
