#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/csv.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/expect_running.hpp"
#include "shelfbeam/scene/fixture/fixture_builder.hpp"
#include "shelfbeam/scene/planogram/article_labels.hpp"
#include "shelfbeam/scene/planogram/fixture_places.hpp"
#include "shelfbeam/scene/planogram/segment_places.hpp"
#include "shelfbeam/scene/store/scene_memory.hpp"
#include "shelfbeam/scene/store/store_parts.hpp"

namespace shelfbeam {

namespace {

class Planogram {
 public:
  Planogram(const ArticleLabels& labels, const StoreNames& names, Store& store, Problems& problems)
      : labels_(labels), names_(names), store_(store), problems_(problems), styles_(store.fixtures.size()) {}

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

  void read(const TableFile& table, const JsonCursor& section) {
    const InputFile& file = table.file;
    const std::string text = table.read(store_.warnings);
    CsvReader csv = planogram_reader(text, file.name());
    if (labels_.segments.empty()) {
      const FixtureColumns columns = read_fixture_columns(csv, file.name());
      FixturePlaces places(labels_, columns, names_, store_, problems_);
      read_records(csv, columns, places);
      add_labels(places.finish());
    } else {
      for (const char* key : {"first_level", "from_top", "first_position"})
        if (const auto given = section.find(key))
          problems_.collect([&] {
            given->fail("does not apply to segments",
                        "remove it; use 'first_shelf' and 'from_top' of 'segments'");
          });
      const std::size_t failures = problems_.failures();
      SegmentPlaces places(labels_.segments, section["segments"], names_, store_, problems_);
      const SegmentColumns columns = read_segment_columns(csv, file.name());
      places.set_columns(columns);
      read_records(csv, columns, places);
      add_labels(places.finish(failures == problems_.failures()));
    }
  }

 private:
  template <class Places>
  void read_records(CsvReader& csv, const PlanogramColumns& columns, Places& places) {
    SceneMemory memory(store_.memory);
    if (labels_.fill_down) csv.fill_down(columns.repeated);
    while (csv.next()) {
      expect_running(store_.cancel);
      problems_.collect([&] {
        csv.expect_fields(columns.required, columns.width);
        const double each = device_bytes_of(csv.fields()[columns.article]);
        memory.add(each * static_cast<double>(places.add(csv)), csv.where());
      });
    }
    if (auto warning = csv.warning_of_ids()) store_.warnings.push_back(std::move(*warning));
  }

  void add_labels(const std::vector<PlanogramPlace>& places) {
    std::map<std::string, int> times;
    for (const PlanogramPlace& place : places) {
      const int time = ++times[place.article];
      Label label = label_at(place);
      label.id = time == 1 ? place.article : fmt::format("{}/{}", place.article, time);
      store_.labels.push_back({std::move(label), place.where});
    }
  }

  Label label_at(const PlanogramPlace& place) const {
    const Fixture& fixture = store_.fixtures[place.fixture].value;
    const LabelSides sides = *label_sides(fixture);
    OwnStyle style = styles_[place.fixture];
    style.replace_by(place.style);
    Label label;
    label.type = style.type.value_or(labels_.style.type);
    label.description = place.description;
    label.place.fixture = id_of(fixture);
    EdgePlace local;
    if (place.face) {
      label.place.face = place.face;
      label.place.board = sides.top ? 0 : place.level;
      label.place.along = place.along;
      local = edge_place(sides.footing, *place.face, place.along, style.hook.value_or(labels_.style.hook),
                         sides.heights[static_cast<std::size_t>(place.level) - 1],
                         style.tilt_deg.value_or(labels_.style.tilt_deg));
    } else {
      // A label that lies on the top faces up, unless it is tilted towards the front.
      constexpr double upright = 90;
      const double across = place.across.value_or(sides.footing.depth / 2);
      local = edge_place(sides.footing, Face::front, place.along, -across, *sides.top,
                         style.tilt_deg.value_or(upright));
    }
    const EdgePlace placed = in_store(sides.footing, local);
    label.position = placed.position;
    label.normal = placed.normal;
    return label;
  }

  const ArticleLabels& labels_;
  const StoreNames& names_;
  Store& store_;
  Problems& problems_;
  std::vector<OwnStyle> styles_;  // by fixture
};

}  // namespace

void read_planogram(const JsonCursor& section, const StoreNames& names, const StoreFolder& folder,
                    Store& store, Problems& problems) {
  ArticleLabels labels;
  if (!read_object(section, names, problems, [&](Fields& f) { labels.fields(f); })) return;
  Planogram planogram(labels, names, store, problems);
  if (const auto list = section.find("fixtures")) planogram.find_styles(*list);
  planogram.read({folder.find(section["file"]), labels.encoding}, section);
}

}  // namespace shelfbeam
