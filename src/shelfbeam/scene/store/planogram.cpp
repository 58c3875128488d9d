#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/base/csv.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/expect_running.hpp"
#include "shelfbeam/scene/fixture/edge_place.hpp"
#include "shelfbeam/scene/fixture/fixture_builder.hpp"
#include "shelfbeam/scene/fixture/turn.hpp"
#include "shelfbeam/scene/label/description_column.hpp"
#include "shelfbeam/scene/read_values.hpp"
#include "shelfbeam/scene/store/device_fields.hpp"
#include "shelfbeam/scene/store/scene_memory.hpp"
#include "shelfbeam/scene/store/store_parts.hpp"

namespace shelfbeam {

namespace {

/// A place on the edge of a board.
struct Place {
  std::string article, where, description;
  LabelTypeId type;
  std::size_t fixture = 0;
  Face face = Face::front;
  int level = 1;
  double x = 0;      ///< m, unless there is a position
  int position = 0;  ///< from 1
};

using Board = std::tuple<std::size_t, Face, int>;

class Planogram {
 public:
  Planogram(const ArticleLabels& labels, const StoreNames& names, Store& store, Problems& problems)
      : labels_(labels), names_(names), store_(store), problems_(problems) {
    for (std::size_t f = 0; f < store.fixtures.size(); ++f) index_.emplace(id_of(store.fixtures[f].value), f);
  }

  void read(const InputFile& file) {
    const std::string text = file.read();
    CsvReader csv(text, file.name());
    const Columns columns = read_header(csv, file.name());
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
  // The fields of a record.
  struct Columns {
    std::size_t article = 0, fixture = 0, face = 0, level = 0, place = 0;
    std::optional<std::size_t> type, description;
    bool by_x = false;  ///< whether `place` is x instead of a position
    std::size_t required = 0, width = 0;
  };

  static Columns read_header(CsvReader& csv, const std::string& file) {
    constexpr const char* expected =
        "the first line must have the columns article, fixture, face, level, and x or position";
    const std::set<std::string_view> known{"article", "fixture", "face", "level", "x", "position", "type"};
    if (!csv.next()) throw InputError(file, "is empty", expected);
    Columns columns;
    const std::vector<std::string> fields = csv.column_names();
    columns.width = fields.size();
    const auto find = [&](std::string_view name) {
      if (std::count(fields.begin(), fields.end(), name) > 1)
        csv.fail(fmt::format("has several columns {}", in_quotes(name)), "rename or remove all but one");
      return static_cast<std::size_t>(std::find(fields.begin(), fields.end(), name) - fields.begin());
    };
    const auto meant = [&](std::string_view name) -> std::string {
      const std::string near = nearest(name, csv.fields());
      return near.empty() || known.contains(lower_case(near))
                 ? expected
                 : fmt::format("rename {} if it is meant", in_quotes(near));
    };
    const auto column = [&](std::string_view name) {
      const std::size_t k = find(name);
      if (k == fields.size()) csv.fail(fmt::format("has no column {}", in_quotes(name)), meant(name));
      columns.required = std::max(columns.required, k + 1);
      return k;
    };
    columns.article = column("article");
    columns.fixture = column("fixture");
    columns.face = column("face");
    columns.level = column("level");
    columns.by_x = find("x") < fields.size();
    if (columns.by_x && find("position") < fields.size())
      csv.fail("has both columns 'x' and 'position'", "remove one of the two");
    columns.place = column(columns.by_x ? "x" : "position");
    if (find("type") < fields.size()) columns.type = column("type");
    columns.description = description_column(csv);
    return columns;
  }

  LabelTypeId read_type(const CsvReader& csv, const Columns& at) const {
    if (!at.type) return labels_.type;
    const std::string name(csv.text(*at.type));
    return name.empty() ? labels_.type : names_.label_type(name, csv.where());
  }

  Place read_place(CsvReader& csv, const Columns& at) const {
    Place place;
    place.article = csv.id(at.article);
    place.where = csv.where();
    if (at.description && *at.description < csv.fields().size())
      place.description = description_of(csv.text(*at.description));
    const auto found = index_.find(csv.text(at.fixture));
    if (found == index_.end()) expect_fixtures(problems_, csv.text(at.fixture));
    if (found == index_.end())
      csv.fail(at.fixture, fmt::format("names the unknown fixture {}", in_quotes(csv.text(at.fixture))),
               id_remedy(csv.text(at.fixture), "correct the id, or add the fixture to the store"));
    place.fixture = found->second;
    place.type = read_type(csv, at);
    const Fixture& fixture = store_.fixtures[place.fixture].value;
    const Shelving* shelves = shelving_of(fixture);
    const auto [faces, levels] = label_edges(fixture).value_or(LabelEdges{});
    if (levels.empty())
      csv.fail(at.fixture, "names a fixture without boards", fmt::format("use {}", types_with_boards));
    const auto face = from_text<Face>(lower_case(csv.text(at.face)));
    if (!face || std::find(faces.begin(), faces.end(), *face) == faces.end()) {
      std::vector<std::string_view> known;
      known.reserve(faces.size());
      for (const Face one : faces) known.push_back(to_text(one));
      csv.fail(at.face, fmt::format("is {}", in_quotes(csv.text(at.face))),
               fmt::format("use a face of the fixture: {}", fmt::join(known, ", ")));
    }
    place.face = *face;
    place.level = whole(csv, at.level, static_cast<int>(levels.size()));
    if (at.by_x) {
      place.x = read_coordinate(csv.number(at.place), store_.unit, csv.where());
      const double edge = edge_length(*shelves, place.face);
      if (!(place.x >= 0 && place.x <= edge))
        csv.fail(at.place, fmt::format("is {}", length_text(place.x, store_.unit)),
                 fmt::format("the edge extends from 0 to {}", length_text(edge, store_.unit)));
    } else {
      constexpr int max_positions = 1000;
      place.position = whole(csv, at.place, max_positions);
    }
    return place;
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
      int& count = largest[{place.fixture, place.face, place.level}];
      count = std::max(count, place.position);
    }
    std::map<std::string, int> times;
    for (const Place& place : places_) {
      const double edge = edge_length(*shelving_of(store_.fixtures[place.fixture].value), place.face);
      const double along = place.position == 0 ? place.x
                                               : edge * (place.position - 0.5) /
                                                     largest[{place.fixture, place.face, place.level}];
      const int time = ++times[place.article];
      Label label = label_at(place, along);
      label.id = time == 1 ? place.article : fmt::format("{}/{}", place.article, time);
      store_.labels.push_back({std::move(label), place.where});
    }
  }

  Label label_at(const Place& place, double along) const {
    const Fixture& fixture = store_.fixtures[place.fixture].value;
    const Shelving& one = *shelving_of(fixture);
    const double z = label_edges(fixture)->heights[static_cast<std::size_t>(place.level) - 1];
    const auto& [position, normal] = edge_place(one, place.face, along, labels_.hook, z, labels_.tilt_deg);
    const Vec2 from_origin = turned({position.x, position.y}, one.rotation_deg),
               direction = turned({normal.x, normal.y}, one.rotation_deg);
    Label label;
    label.position = {one.at[0] + from_origin[0], one.at[1] + from_origin[1], z};
    label.normal = {direction[0], direction[1], normal.z};
    label.type = place.type;
    label.description = place.description;
    label.place = {.fixture = id_of(fixture), .face = place.face, .board = place.level, .along = along};
    return label;
  }

  ArticleLabels labels_;
  const StoreNames& names_;
  Store& store_;
  Problems& problems_;
  std::map<std::string, std::size_t, std::less<>> index_;
  std::vector<Place> places_;
};

}  // namespace

void read_planogram(const JsonCursor& section, const StoreNames& names, const StoreFolder& folder,
                    Store& store, Problems& problems) {
  ArticleLabels labels;
  if (read_object(section, names, problems, [&](Fields& f) { describe(labels, f); }))
    Planogram(labels, names, store, problems).read(folder.find(section["file"]));
}

}  // namespace shelfbeam
