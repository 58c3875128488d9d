#include <cstdlib>

#include <fmt/ranges.h>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/math/distinct_positions.hpp"
#include "shelfbeam/scene/store/store.hpp"

#include "support/testing.hpp"
#include "unit/scene/solids.hpp"

namespace shelfbeam::test {
namespace {

namespace fs = std::filesystem;

const fs::path examples = fs::path(SHELFBEAM_SOURCE_DIR) / "examples";

Scene example(const char* name) {
  return make_scene(read_store(examples / name / "store.json"));
}

TEST(Thesis, HasTheCountsOfTheErrata) {
  const Scene scene = example("thesis");
  EXPECT_EQ(scene.labels.size(), 390u);
  EXPECT_EQ(scene.transceivers.size(), 320u);
  std::map<std::string, int> rows;
  for (const Label& label : scene.labels) ++rows[label.id.substr(0, label.id.rfind('-'))];
  EXPECT_EQ(rows.size(), 4u * 2 * 3 + 2);
  for (const auto& [row, count] : rows) EXPECT_EQ(count, 15) << row;
  EXPECT_TRUE(scene.warnings.empty());
  EXPECT_EQ(scene.room->upper(), (Vec3{20, 16, 4}));
  for (const NamedMaterial& named : scene.materials)
    EXPECT_EQ(std::get<Lambertian>(named.material).reflectance, 0.7) << named.name;
}

// A scene's labels, candidates and parts, optionally mirrored about x = 10; sorted, in units of 0.1 um.
using Shape = std::vector<long>;
std::vector<Shape> shapes(const Scene& scene, bool mirrored) {
  const auto rounded = [](double value) { return std::lround(value * 1e7); };
  const auto x = [&](double value) { return rounded(mirrored ? 20 - value : value); };
  std::vector<Shape> result;
  for (const Label& label : scene.labels)
    result.push_back({0, x(label.position.x), rounded(label.position.y), rounded(label.position.z),
                      rounded(mirrored ? -label.normal.x : label.normal.x), rounded(label.normal.y),
                      rounded(label.normal.z)});
  for (const Transceiver& unit : scene.transceivers)
    result.push_back({1, x(unit.position.x), rounded(unit.position.y), rounded(unit.position.z)});
  for (const Part& part : scene.parts) {
    std::vector<std::array<long, 2>> corners;
    for (const auto& [a, b] : part.footprint) corners.push_back({x(a), rounded(b)});
    std::sort(corners.begin(), corners.end());
    Shape shape{2, static_cast<long>(part.kind), rounded(part.bottom), rounded(part.top)};
    for (const auto& [a, b] : corners) shape.insert(shape.end(), {a, b});
    result.push_back(std::move(shape));
  }
  std::sort(result.begin(), result.end());
  return result;
}

TEST(Thesis, IsItsOwnMirrorImage) {
  const Scene scene = example("thesis");
  EXPECT_EQ(shapes(scene, true), shapes(scene, false));
  Store store = read_store(examples / "thesis" / "store.json");
  std::get<Gondola>(store.fixtures[2].value).stocking = 0.95;
  const Scene uneven = make_scene(store);
  EXPECT_NE(shapes(uneven, true), shapes(uneven, false)) << "goods with gaps must show";
}

TEST(Grocery, LooksLikeOne) {
  const Scene scene = example("grocery");
  EXPECT_GE(scene.labels.size(), 600u);
  EXPECT_LE(scene.labels.size(), 1000u);
  EXPECT_NEAR(static_cast<double>(scene.transceivers.size()), 300, 30);
  std::map<std::string, int> kinds;
  for (const FixtureOutline& fixture : scene.fixtures) ++kinds[fixture.type];
  EXPECT_GE(kinds["gondola"], 10);
  EXPECT_GE(kinds["freezer"], 1);
  EXPECT_EQ(kinds["mesh"], 3);
  EXPECT_GE(kinds["box"], 1);
  EXPECT_GE(scene.label_types.size(), 2u);
  EXPECT_GE(scene.materials.size(), 4u);
  EXPECT_TRUE(scene.warnings.empty());
}

// All that light and placement depend on, in no particular order: coordinates in units of 0.1 um, and names.
std::vector<std::string> contents(const Scene& scene) {
  std::vector<std::string> result;
  const auto point = [](const Vec3& p) {
    return fmt::format("{} {} {}", std::lround(p.x * 1e7), std::lround(p.y * 1e7), std::lround(p.z * 1e7));
  };
  for (std::size_t t = 0; t < scene.mesh.triangles.size(); ++t) {
    std::array<std::string, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = point(scene.mesh.vertices[scene.mesh.triangles[t][k]]);
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    result.push_back(
        fmt::format("{} {}", fmt::join(corners, ", "), scene.materials[scene.mesh.materials[t].value].name));
  }
  for (const Label& label : scene.labels)
    result.push_back(fmt::format("{} {} {} {}", label.id, point(label.position), point(label.normal),
                                 scene.label_types[label.type.value].name));
  for (const Transceiver& unit : scene.transceivers)
    result.push_back(fmt::format("{} {} {}", unit.id, point(unit.position), point(unit.axis)));
  for (const NamedMaterial& named : scene.materials) {
    const auto range = named.reflectance_range.value_or(std::array<double, 2>{});
    result.push_back(
        fmt::format("{} {} {}-{}", named.name, *given_reflectance(named.material), range[0], range[1]));
  }
  for (const LabelType& type : scene.label_types)
    result.push_back(fmt::format("{} {} {}", type.name, type.threshold, type.safety_factor));
  std::sort(result.begin(), result.end());
  return result;
}

TEST(Grocery, EqualsTheListOfItsFixtures) {
  const fs::path folder = examples / "grocery";
  const std::string listed = read_file(fs::path(SHELFBEAM_SOURCE_DIR) / "test/data/grocery_listed.jsonc");
  const auto expected = contents(make_scene(parse_store(listed, "listed", folder)));
  EXPECT_EQ(contents(example("grocery")), expected);
  Store moved = read_store(folder / "store.json");
  std::get<Gondola>(moved.fixtures[2].value).at[0] += 1e-6;
  EXPECT_NE(contents(make_scene(moved)), expected);
  const std::string ours = read_file(folder / "store.json");
  EXPECT_LT(2 * std::count(ours.begin(), ours.end(), '\n'), std::count(listed.begin(), listed.end(), '\n'));
}

// Every shape, source of labels and source of candidates.
TEST(MarketHall, UsesEveryShape) {
  const Scene scene = example("market-hall");
  EXPECT_EQ(sentences(scene.warnings), std::vector<std::string>{});
  std::set<std::string> kinds, sources;
  for (const FixtureOutline& fixture : scene.fixtures) kinds.insert(fixture.type);
  EXPECT_EQ(kinds,
            (std::set<std::string>{"box", "cylinder", "freezer", "gondola", "panel", "prism", "wall"}));
  for (const Transceiver& unit : scene.transceivers) sources.insert(unit.id.substr(0, unit.id.find('-')));
  EXPECT_EQ(sources, (std::set<std::string>{"A1", "A2", "A3", "bakery wall", "column 2", "rail", "wall"}));
  EXPECT_EQ(scene.room->zones.size(), 2u);
  EXPECT_EQ(scene.room->holes.size(), 1u);
  EXPECT_TRUE(std::any_of(scene.labels.begin(), scene.labels.end(),
                          [](const Label& label) { return label.id == "4001686301265/2"; }));
}

// Glass doors and a lid, meshes in two formats, profiles in two, several orientations at a mounting point, a
// requirement as a range, an installed unit and an area without units.
TEST(Chiller, HasDoorsAndFreezers) {
  const Store store = read_store(examples / "chiller" / "store.json");
  const Scene scene = make_scene(store);
  EXPECT_TRUE(scene.warnings.empty());
  EXPECT_NEAR(static_cast<double>(scene.labels.size()), 150, 50);
  EXPECT_NEAR(static_cast<double>(scene.transceivers.size()), 175, 75);
  std::set<std::size_t> kinds;
  for (const NamedMaterial& material : scene.materials) kinds.insert(material.material.index());
  EXPECT_EQ(kinds.size(), 5u);
  std::map<PartKind, int> parts;
  for (const Part& part : scene.parts) ++parts[part.kind];
  EXPECT_EQ(parts[PartKind::door], 2);
  EXPECT_GE(parts[PartKind::mesh], 2);
  for (const TransceiverType& type : scene.transceiver_types)
    EXPECT_EQ(type.file, type.name == "ring" ? "batwing.ies" : "narrow-aisle.ldt");
  std::map<std::uint32_t, int> options;
  for (const std::uint32_t place : distinct_positions(positions_of(scene.transceivers)).group_of)
    ++options[place];
  EXPECT_TRUE(std::any_of(options.begin(), options.end(), [](const auto& o) { return o.second >= 3; }));
  EXPECT_EQ(std::count_if(scene.transceivers.begin(), scene.transceivers.end(),
                          [](const Transceiver& unit) { return unit.installed; }),
            1);
  for (const char* profile : {"batwing.ies", "narrow-aisle.ldt"})
    EXPECT_TRUE(read_file(examples / "chiller" / profile) ==
                read_file(fs::path(SHELFBEAM_SOURCE_DIR) / "data" / "photometry" / profile))
        << profile << " has moved on in one of its two places";
}

struct Market {
  const char* name;
  std::size_t labels, candidates;
};
constexpr std::array markets{Market{"supermarket", 5000, 600}, Market{"hypermarket", 40000, 2000}};

TEST(Markets, EqualTheOutputOfTheScript) {
  EXPECT_EQ(std::system("python3 '" SHELFBEAM_SOURCE_DIR "/scripts/make-large-examples' --check"), 0);
}

TEST(Markets, HaveTheirCountsAndNoWarnings) {
  for (const auto& [name, labels, candidates] : markets) {
    const Scene scene = example(name);
    EXPECT_EQ(scene.labels.size(), labels) << name;
    EXPECT_EQ(scene.transceivers.size(), candidates) << name;
    EXPECT_TRUE(scene.warnings.empty()) << name << ": " << scene.warnings.front().sentence;
    std::set<double> heights;
    for (const FixtureOutline& fixture : scene.fixtures)
      if (fixture.type == "gondola") heights.insert(fixture.height);
    EXPECT_GE(heights.size(), 5u);
    EXPECT_TRUE(std::any_of(scene.parts.begin(), scene.parts.end(),
                            [](const Part& part) { return part.kind == PartKind::door; }));
  }
}

// The area between two points of the floor, or around some points.
struct Extent {
  std::array<double, 2> low{1e9, 1e9}, high{-1e9, -1e9};
  void include(double x, double y) {
    low = {std::min(low[0], x), std::min(low[1], y)};
    high = {std::max(high[0], x), std::max(high[1], y)};
  }
  bool meets(const Extent& o) const {
    return low[0] < o.high[0] && o.low[0] < high[0] && low[1] < o.high[1] && o.low[1] < high[1];
  }
};

// There is an aisle in front of every label. All fixtures are parallel to x or y, so they cover their
// extents.
TEST(Markets, LabelsFaceAisles) {
  for (const Market& market : markets) {
    const Scene scene = example(market.name);
    std::vector<Extent> fixtures(scene.fixtures.size());
    for (std::size_t k = 0; k < fixtures.size(); ++k)
      for (const auto& [x, y] : scene.fixtures[k].footprint) fixtures[k].include(x, y);
    const auto blocked = [&](double width) {
      std::vector<std::string> ids;
      for (const Label& label : scene.labels) {
        Extent way;
        const double level = std::hypot(label.normal.x, label.normal.y);
        for (const double off : {0.1, width})  // a door is 6 cm in front of the boards
          way.include(label.position.x + off * label.normal.x / level,
                      label.position.y + off * label.normal.y / level);
        if (way.low[0] < 0 || way.low[1] < 0 || way.high[0] > scene.room->upper().x ||
            way.high[1] > scene.room->upper().y ||
            std::any_of(fixtures.begin(), fixtures.end(), [&](const Extent& f) { return f.meets(way); }))
          ids.push_back(label.id);
      }
      return ids;
    };
    EXPECT_EQ(blocked(1), std::vector<std::string>{}) << market.name;
    EXPECT_GT(blocked(2.5).size(), market.labels / 2) << "the check must find the other side of the aisles";
  }
}

}  // namespace
}  // namespace shelfbeam::test
