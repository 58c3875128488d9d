#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/base/csv.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/length_unit.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/expect_running.hpp"
#include "shelfbeam/scene/fixture/fixture_builder.hpp"
#include "shelfbeam/scene/label/description_column.hpp"
#include "shelfbeam/scene/planogram/article_labels.hpp"
#include "shelfbeam/scene/planogram/label_sides.hpp"
#include "shelfbeam/scene/planogram/planogram_columns.hpp"
#include "shelfbeam/scene/read_values.hpp"
#include "shelfbeam/scene/store/scene_memory.hpp"
#include "shelfbeam/scene/store/store_parts.hpp"

namespace shelfbeam {

namespace {

/// A place of an article.
struct Place {
  std::string article, where, description;
  OwnStyle style;
  std::size_t fixture = 0;
  std::optional<Face> face;  ///< nothing for the top
  int level = 1;
  double x = 0;             ///< m, unless there is a position
  std::optional<double> y;  ///< m, on the top
  int position = 0;         ///< from 1
};

// The edges, and the tops with level 0, between which positions are counted.
using Board = std::tuple<std::size_t, std::optional<Face>, int>;

Board board_of(const Place& place) {
  return {place.fixture, place.face, place.level};
}

class Planogram {
 public:
  Planogram(const ArticleLabels& labels, const StoreNames& names, Store& store, Problems& problems)
      : labels_(labels), names_(names), store_(store), problems_(problems), styles_(store.fixtures.size()) {
    for (std::size_t f = 0; f < store.fixtures.size(); ++f) index_.emplace(id_of(store.fixtures[f].value), f);
  }

  // Later members of `fixtures` replace earlier ones.
  void find_styles(const JsonCursor& list) {
    std::vector<std::string_view> ids, patterns;
    for (const auto& [fixture, where] : store_.fixtures) ids.push_back(id_of(fixture));
    for (const StyledFixtures& one : labels_.fixtures) patterns.push_back(one.pattern);
    expect_few_comparisons(list, ids, patterns);
    for (std::size_t k = 0; k < patterns.size(); ++k) {
      const std::vector<std::uint32_t> found = matching_ids(patterns[k], ids);
      for (const std::uint32_t f : found) styles_[f].replace_by(labels_.fixtures[k].style);
      problems_.collect([&, k] {
        if (!found.empty()) return;
        problems_.expect_complete("some fixture");
        list.element(k)["fixtures"].fail("matches no fixture", "correct it, or remove the member");
      });
    }
  }

  void read(const InputFile& file) {
    const std::string text = file.read();
    CsvReader csv(text, file.name());
    const PlanogramColumns columns = read_planogram_header(csv, file.name());
    SceneMemory memory(store_.memory);
    while (csv.next()) {
      expect_running(store_.cancel);
      if (problems_.collect([&] {
            csv.expect_fields(columns.required, columns.width);
            places_.push_back(read_place(csv, columns));
          }))
        memory.add(device_bytes_of(places_.back().article), csv.where());
    }
    if (auto warning = csv.warning_of_ids()) store_.warnings.push_back(std::move(*warning));
    add_labels();
  }

 private:
  const Fixture& fixture_of(const Place& place) const { return store_.fixtures[place.fixture].value; }

  Place read_place(CsvReader& csv, const PlanogramColumns& at) const {
    Place place;
    place.article = csv.id(at.article);
    place.where = csv.where();
    if (has_value(csv, at.description)) place.description = description_of(csv.text(*at.description));
    const auto found = index_.find(csv.text(at.fixture));
    if (found == index_.end()) expect_fixtures(problems_, csv.text(at.fixture));
    if (found == index_.end())
      csv.fail(at.fixture, fmt::format("names the unknown fixture {}", in_quotes(csv.text(at.fixture))),
               id_remedy(csv.text(at.fixture), "correct the id, or add the fixture to the store"));
    place.fixture = found->second;
    if (has_value(csv, at.type)) place.style.type = names_.label_type(csv.text(*at.type), csv.where());
    const auto sides = label_sides(fixture_of(place));
    if (!sides || sides->heights.empty())
      csv.fail(at.fixture, "names a fixture without boards", fmt::format("use {}", types_with_sides));
    read_face(csv, at.face, *sides, place);
    place.level = whole(csv, at.level, place.face ? static_cast<int>(sides->heights.size()) : 1);
    if (at.by_x) {
      place.x = read_distance(csv, at.place, length_of(*sides, place), "edge");
    } else {
      constexpr int max_positions = 1000;
      place.position = whole(csv, at.place, max_positions);
    }
    if (!place.face && has_value(csv, at.y)) place.y = read_distance(csv, *at.y, sides->footing.depth, "top");
    read_style(csv, at, place);
    return place;
  }

  static void read_face(const CsvReader& csv, std::size_t field, const LabelSides& sides, Place& place) {
    constexpr std::string_view top = "top";
    const std::string name = lower_case(csv.text(field));
    if (sides.top && name == top) return;
    place.face = from_text<Face>(name);
    if (place.face && std::find(sides.faces.begin(), sides.faces.end(), *place.face) != sides.faces.end())
      return;
    std::vector<std::string_view> known;
    for (const Face one : sides.faces) known.push_back(to_text(one));
    if (sides.top) known.push_back(top);
    csv.fail(field, fmt::format("is {}", in_quotes(csv.text(field))),
             fmt::format("use a face of the fixture: {}", fmt::join(known, ", ")));
  }

  void read_style(CsvReader& csv, const PlanogramColumns& at, Place& place) const {
    if (has_value(csv, at.hook)) {
      if (!place.face) csv.fail(*at.hook, "does not apply to labels on the top", "leave it empty");
      constexpr double least = 1e-3, most = 1e3;  // m, as for lengths in the store file
      place.style.hook = to_metres(csv.number(*at.hook), store_.unit);
      if (!(*place.style.hook >= least && *place.style.hook <= most))
        csv.fail(
            *at.hook, fmt::format("is {}", length_text(*place.style.hook, store_.unit)),
            fmt::format("use {} to {}", length_text(least, store_.unit), length_text(most, store_.unit)));
    }
    if (has_value(csv, at.tilt_deg)) {
      place.style.tilt_deg = csv.number(*at.tilt_deg);
      if (!(*place.style.tilt_deg >= least_label_tilt && *place.style.tilt_deg <= most_label_tilt))
        csv.fail(*at.tilt_deg, fmt::format("is {:g}", *place.style.tilt_deg),
                 fmt::format("use a value from {:g} to {:g}", least_label_tilt, most_label_tilt));
    }
  }

  static double length_of(const LabelSides& sides, const Place& place) {
    return place.face ? edge_length(sides.footing, *place.face) : sides.footing.length;
  }

  double read_distance(CsvReader& csv, std::size_t field, double longest, std::string_view what) const {
    const double value = read_coordinate(csv.number(field), store_.unit, csv.where());
    if (!(value >= 0 && value <= longest))
      csv.fail(field, fmt::format("is {}", length_text(value, store_.unit)),
               fmt::format("the {} extends from 0 to {}", what, length_text(longest, store_.unit)));
    return value;
  }

  static int whole(CsvReader& csv, std::size_t field, int most) {
    const double value = csv.number(field);
    if (value != std::floor(value) || value < 1 || value > most)
      csv.fail(field, fmt::format("is {:g}", value), fmt::format("use a whole number from 1 to {}", most));
    return static_cast<int>(value);
  }

  // Positions are spread evenly over the edge, as many as the largest position on it.
  void add_labels() {
    std::map<Board, int> largest;
    for (const Place& place : places_) {
      int& count = largest[board_of(place)];
      count = std::max(count, place.position);
    }
    std::map<std::string, int> times;
    for (const Place& place : places_) {
      const LabelSides sides = *label_sides(fixture_of(place));
      const double along = place.position == 0
                               ? place.x
                               : length_of(sides, place) * (place.position - 0.5) / largest[board_of(place)];
      const int time = ++times[place.article];
      Label label = label_at(place, sides, along);
      label.id = time == 1 ? place.article : fmt::format("{}/{}", place.article, time);
      store_.labels.push_back({std::move(label), place.where});
    }
  }

  Label label_at(const Place& place, const LabelSides& sides, double along) const {
    OwnStyle style = styles_[place.fixture];
    style.replace_by(place.style);
    Label label;
    label.type = style.type.value_or(labels_.style.type);
    label.description = place.description;
    label.place.fixture = id_of(fixture_of(place));
    EdgePlace local;
    if (place.face) {
      label.place.face = place.face;
      label.place.board = sides.top ? 0 : place.level;
      label.place.along = along;
      local = edge_place(sides.footing, *place.face, along, style.hook.value_or(labels_.style.hook),
                         sides.heights[static_cast<std::size_t>(place.level) - 1],
                         style.tilt_deg.value_or(labels_.style.tilt_deg));
    } else {
      // A label that lies on the top faces up, unless it is tilted towards the front.
      constexpr double upright = 90;
      const double across = place.y.value_or(sides.footing.depth / 2);
      local = edge_place(sides.footing, Face::front, along, -across, *sides.top,
                         style.tilt_deg.value_or(upright));
    }
    const EdgePlace placed = in_store(sides.footing, local);
    label.position = placed.position;
    label.normal = placed.normal;
    return label;
  }

  ArticleLabels labels_;
  const StoreNames& names_;
  Store& store_;
  Problems& problems_;
  std::map<std::string, std::size_t, std::less<>> index_;
  std::vector<OwnStyle> styles_;  // by fixture
  std::vector<Place> places_;
};

}  // namespace

void read_planogram(const JsonCursor& section, const StoreNames& names, const StoreFolder& folder,
                    Store& store, Problems& problems) {
  ArticleLabels labels;
  if (!read_object(section, names, problems, [&](Fields& f) { labels.fields(f); })) return;
  Planogram planogram(labels, names, store, problems);
  if (const auto list = section.find("fixtures")) planogram.find_styles(*list);
  planogram.read(folder.find(section["file"]));
}

}  // namespace shelfbeam
