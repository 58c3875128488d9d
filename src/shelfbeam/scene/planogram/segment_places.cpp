#include "shelfbeam/scene/planogram/segment_places.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <tuple>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/read_values.hpp"
#include "shelfbeam/scene/store/store_parts.hpp"

namespace shelfbeam {

namespace {

constexpr int max_number = 1'000'000;  // of segments and shelves

// "segment 3", "segment 3 of planogram 'P12'"
std::string segment_text(const std::string& planogram, int segment) {
  return planogram.empty() ? fmt::format("segment {}", segment)
                           : fmt::format("segment {} of planogram {}", segment, in_quotes(planogram));
}

}  // namespace

SegmentPlaces::SegmentPlaces(const std::vector<SegmentPlace>& segments, const JsonCursor& list,
                             const StoreNames& names, const Store& store, Problems& problems)
    : given_(segments), list_(list), names_(names), store_(store), problems_(problems) {
  for (std::size_t k = 0; k < segments.size(); ++k) {
    members_.emplace_back();
    members_[k].has_problem =
        !problems_.collect([&, k] { members_[k] = read_member(segments[k], list.element(k)); });
    for (const double segment : segments[k].segments)
      listed_[{segments[k].planogram, static_cast<int>(segment)}].push_back(k);
    if (segments[k].segments.empty()) whole_[segments[k].planogram].push_back(k);
  }
}

SegmentPlaces::Member SegmentPlaces::read_member(const SegmentPlace& given, const JsonCursor& json) const {
  Member member;
  const auto is_named = [&](const auto& listed) { return id_of(listed.value) == given.fixture; };
  const auto found = std::find_if(store_.fixtures.begin(), store_.fixtures.end(), is_named);
  if (found == store_.fixtures.end()) {
    expect_fixtures(problems_, given.fixture);
    json["fixture"].fail(fmt::format("names the unknown fixture {}", in_quotes(given.fixture)),
                         "correct the id, or add the fixture to the store");
  }
  member.fixture = static_cast<std::size_t>(std::distance(store_.fixtures.begin(), found));
  const auto sides = label_sides(found->value);
  if (!sides || sides->heights.empty())
    json["fixture"].fail("names a fixture without boards", fmt::format("use {}", types_with_sides));
  member.sides = *sides;
  if (!sides->has(given.face))
    json["face"].fail("is not a face of the fixture", fmt::format("use one of {}", known_faces(*sides)));
  const double length = sides->length(given.face), end = given.to.value_or(length);
  if (end > length)
    json["to"].fail(fmt::format("is {}, beyond the face of {}", length_text(end, json.unit()),
                                length_text(length, json.unit())),
                    "correct it");
  if (given.from >= end)
    json["from"].fail(fmt::format("is {}, not before the end at {}", length_text(given.from, json.unit()),
                                  length_text(end, json.unit())),
                      "correct it");
  member.span = end - given.from;
  for (std::size_t k = 0; k < given.segments.size(); ++k) {
    const double segment = given.segments[k];
    const JsonCursor number = json["segments"].element(k);
    if (segment != std::floor(segment) || segment > max_number)
      number.fail("is not the number of a segment", fmt::format("use whole numbers up to {}", max_number));
    if (std::ranges::count(member.segments, static_cast<int>(segment)) > 0)
      number.fail("is a duplicate", "remove it");
    member.segments.push_back(static_cast<int>(segment));
  }
  return member;
}

std::vector<std::size_t> SegmentPlaces::members_with(const std::string& planogram, int segment) const {
  std::vector<std::size_t> found;
  const auto append = [&](const auto& map, const auto& key) {
    if (const auto members = map.find(key); members != map.end())
      found.insert(found.end(), members->second.begin(), members->second.end());
  };
  append(listed_, std::pair(planogram, segment));
  append(whole_, planogram);
  if (!planogram.empty()) {  // members without a planogram
    append(listed_, std::pair(std::string(), segment));
    append(whole_, std::string());
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::size_t SegmentPlaces::add(CsvReader& csv) {
  const PlanogramRecord record(csv, columns_, names_, store_.unit);
  Entry entry;
  entry.place = record.begin();
  const auto number = [&](std::size_t field) {
    const double value = csv.amount(field);
    if (value != std::floor(value) || value > max_number)
      csv.fail(field, fmt::format("is {:g}", value), fmt::format("use a whole number up to {}", max_number));
    return static_cast<int>(value);
  };
  entry.segment = number(columns_.segment);
  entry.shelf = number(columns_.shelf);
  entry.sequence = csv.amount(columns_.sequence);
  if (has_value(csv, columns_.product_width)) entry.width = csv.amount(*columns_.product_width);
  if (has_value(csv, columns_.facings)) entry.facings = csv.amount(*columns_.facings);
  const std::string planogram = columns_.planogram ? csv.text(*columns_.planogram) : std::string();
  planograms_.insert(planogram);
  record.read_type(entry.place.style);
  const std::vector<std::size_t> members = members_with(planogram, entry.segment);
  if (members.empty())
    csv.fail(columns_.segment,
             fmt::format("names {}, which 'segments' of the store's planogram does not place",
                         segment_text(planogram, entry.segment)),
             "add it there");
  const auto has_problem = [&](std::size_t k) { return members_[k].has_problem; };
  if (std::any_of(members.begin(), members.end(), has_problem)) throw Consequence{};
  const auto on_top = [&](std::size_t k) { return !given_[k].face; };
  record.read_mounting(entry.place.style, std::all_of(members.begin(), members.end(), on_top));
  std::vector<Entry> added(members.size(), entry);
  for (std::size_t k = 0; k < members.size(); ++k) {
    added[k].member = members[k];
    added[k].place.fixture = members_[members[k]].fixture;
    added[k].place.face = given_[members[k]].face;
    added[k].place.level = level_on(csv, members[k], entry.shelf);
  }
  for (const std::size_t k : members) members_[k].used.insert(entry.segment);
  entries_.insert(entries_.end(), added.begin(), added.end());
  return added.size();
}

// The lowest board has level 1.
int SegmentPlaces::level_on(const CsvReader& csv, std::size_t member, int shelf) const {
  const SegmentPlace& given = given_[member];
  const auto boards = static_cast<int>(members_[member].sides.levels(given.face));
  const int first = static_cast<int>(given.first_shelf), index = shelf - first;
  if (index < 0 || index >= boards)
    csv.fail(columns_.shelf,
             fmt::format("is shelf {}, but {} of {} has {}", shelf,
                         given.face ? fmt::format("the {}", to_text(*given.face)) : "the top",
                         in_quotes(given.fixture), counted(static_cast<std::uint64_t>(boards), "board")),
             fmt::format("use {} to {}, or correct 'first_shelf'", first, first + boards - 1));
  return given.from_top ? boards - index : index + 1;
}

std::vector<PlanogramPlace> SegmentPlaces::finish(bool is_whole) {
  if (is_whole) expect_segments(list_);
  std::map<std::tuple<std::size_t, int, int>, std::vector<Entry*>> shelves;
  for (Entry& entry : entries_) shelves[{entry.member, entry.segment, entry.shelf}].push_back(&entry);
  for (auto& [key, shelf] : shelves) problems_.collect([&, &one = shelf] { share(one); });
  std::vector<PlanogramPlace> places;
  places.reserve(entries_.size());
  for (Entry& entry : entries_) places.push_back(std::move(entry.place));
  return places;
}

// Each article is in the middle of its facings. Gaps between articles are not known, so the facings together
// take the whole width.
void SegmentPlaces::share(std::vector<Entry*> shelf) const {
  std::stable_sort(shelf.begin(), shelf.end(),
                   [](const Entry* a, const Entry* b) { return a->sequence < b->sequence; });
  std::set<std::pair<double, std::string_view>> seen;
  double known = 0;
  std::size_t count = 0;
  for (const Entry* entry : shelf) {
    if (!seen.emplace(entry->sequence, entry->place.article).second)
      throw InputError(entry->place.where,
                       fmt::format("has article {} again at sequence {:g} of shelf {}",
                                   in_quotes(entry->place.article), entry->sequence, entry->shelf),
                       "remove one of the two records");
    known += entry->width;
    count += entry->width > 0 ? 1 : 0;
  }
  const double mean = count > 0 ? known / static_cast<double>(count) : 1;
  const auto width_of = [&](const Entry& entry) {
    return (entry.width > 0 ? entry.width : mean) * (entry.facings > 0 ? entry.facings : 1);
  };
  double total = 0;
  for (const Entry* entry : shelf) total += width_of(*entry);
  const Member& member = members_[shelf.front()->member];
  const SegmentPlace& given = given_[shelf.front()->member];
  const std::vector<int> segments =
      member.segments.empty() ? std::vector(member.used.begin(), member.used.end()) : member.segments;
  const double share = member.span / static_cast<double>(segments.size());
  const double begin =
      share * static_cast<double>(std::ranges::find(segments, shelf.front()->segment) - segments.begin());
  // A person who faces the back or the left side has the end of its edge on the left.
  const bool is_mirrored = given.face == Face::back || given.face == Face::left;
  const double edge = member.sides.length(given.face);
  double before = 0;
  for (Entry* entry : shelf) {
    const double width = width_of(*entry);
    const double run = begin + share * (before + width / 2) / total;
    const double from_left = given.from + (given.right_to_left ? member.span - run : run);
    entry->place.along = is_mirrored ? edge - from_left : from_left;
    before += width;
  }
}

// Each member takes records of the file.
void SegmentPlaces::expect_segments(const JsonCursor& list) const {
  for (std::size_t k = 0; k < members_.size(); ++k)
    problems_.collect([&, k] {
      const SegmentPlace& given = given_[k];
      const JsonCursor json = list.element(k);
      if (given.planogram.empty() && planograms_.size() > 1)
        json.fail(fmt::format("does not name its planogram, but the file has {}", planograms_.size()),
                  "add 'planogram'");
      if (!given.planogram.empty() && !columns_.planogram)
        json["planogram"].fail("names a planogram, but the file has no column 'planogram'", "remove it");
      if (!given.planogram.empty() && !planograms_.contains(given.planogram))
        json["planogram"].fail(
            fmt::format("names {}, which the file does not have", in_quotes(given.planogram)),
            "correct it, or remove the member");
      for (std::size_t j = 0; j < given.segments.size(); ++j)
        if (!members_[k].used.contains(static_cast<int>(given.segments[j])))
          json["segments"].element(j).fail(
              fmt::format("names {}, which the file does not have",
                          segment_text(given.planogram, static_cast<int>(given.segments[j]))),
              "correct it, or remove it");
    });
}

}  // namespace shelfbeam
