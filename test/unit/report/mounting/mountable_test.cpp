// Every unit of random shops can be mounted by the sheet of the page alone.

#include <numbers>
#include <regex>

#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/report/page/sections.hpp"

#include "unit/report/shops.hpp"

namespace shelfbeam::test {
namespace {

// Shops with walls, zones, fixtures and units at random.
class RandomShop {
 public:
  explicit RandomShop(unsigned seed) : random_(seed) {}

  Store store() {
    const double width = between(14, 40), depth = between(12, 60), height = between(3.4, 7);
    Store store = empty_store("Random", {width, depth, height});
    shape_room(store, width, depth);
    add_fixtures(store, width, depth);
    add_label(store, "L", {0.3, 5.5, 1});
    add_units(store, width, depth);
    return store;
  }

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

 private:
  bool one_of(int count) { return std::uniform_int_distribution<int>(1, count)(random_) == 1; }

  void shape_room(Store& store, double width, double depth) {
    RoomShape& shape = store.room->shape;
    const double part = between(3, 5), w = width, d = depth;
    switch (std::uniform_int_distribution<int>(0, 4)(random_)) {
      case 0:
        break;
      case 1:  // an L
        set_outline(store, {{0, 0}, {w, 0}, {w, d - part}, {w - part, d - part}, {w - part, d}, {0, d}});
        break;
      case 2:  // a corner cut at any angle
        set_outline(store, {{0, 0}, {w, 0}, {w, d - part}, {w - between(2, 6), d}, {0, d}});
        break;
      case 3:  // a slanted wall
        set_outline(store, {{0, 0}, {w, 0}, {w, d - part}, {0, d}});
        break;
      default:  // a shaft
        shape.is_box = false;
        set_outline(store, shape.outline);
        shape.holes = {{{11, 6}, {12.5, 6}, {12.5, 7}, {11, 7}}};
    }
    if (one_of(2)) {
      shape.zones = {{"zone-1", {{0, 0}, {5, 0}, {5, 5}, {0, 5}}, {between(2.4, 3), {}}}};
      store.room->zones = {{MaterialId{0}, MaterialId{0}}};
    }
    if (one_of(2)) {
      shape.inner_walls = {{"W1", {8, 0}, {8, between(2, 6)}, 0.2, {}, {}}};
      if (one_of(2)) shape.inner_walls[0].height = 2.2;
      store.room->inner_walls = {{MaterialId{0}, {}}};
    }
  }

  static void set_outline(Store& store, Polygon outline) {
    store.room->shape.is_box = false;
    store.room->walls.assign(outline.size(), MaterialId{0});
    store.room->shape.outline = std::move(outline);
  }

  // Whether a square about a point is free of walls.
  static bool is_free(const RoomShape& shape, const Vec2& at, double half) {
    for (const double x : {at[0] - half, at[0], at[0] + half})
      for (const double y : {at[1] - half, at[1], at[1] + half}) {
        if (!shape.covers({x, y})) return false;
        for (const InnerWall& wall : shape.inner_walls)
          if (distance_to_border(wall.footprint(0, wall.length()), {x, y}) < half / 2 + 0.2) return false;
      }
    return true;
  }

  void add_fixtures(Store& store, double width, double depth) {
    int number = 0;
    for (int column = 0; 3 + 4 * column < width; ++column)
      for (int row = 0; 3 + 4 * row < depth; ++row) {
        const double x = 3 + 4 * column, y = 3 + 4 * row;
        if (one_of(4) || !is_free(store.room->shape, {x, y}, 1.8)) continue;
        add(store, fixture(fmt::format("F{}", ++number), {x, y}));
      }
  }

  Fixture fixture(const std::string& id, const Vec2& at) {
    const double high = between(0.8, 2.3), a = between(0.3, 1), b = between(0.3, 1), x = at[0], y = at[1];
    switch (std::uniform_int_distribution<int>(0, 4)(random_)) {
      case 0:
        return Box{id, {x - a, y - b, 0}, {x + a, y + b, high}, {}};
      case 1:
        return Cylinder{id, at, a / 2, {}, MaterialId{0}};
      case 2:
        return Prism{id,
                     {{x - a, y - b}, {x + a, y - b}, {x + a, y}, {x, y}, {x, y + b}, {x - a, y + b}},
                     {0, high},
                     MaterialId{0}};
      default: {
        constexpr double length = 2.4, width = 0.8;
        const double turns[] = {0, 90, between(0, 180)};
        const double turn = turns[std::uniform_int_distribution<int>(0, 2)(random_)];
        const double c = std::cos(turn * std::numbers::pi / 180), s = std::sin(turn * std::numbers::pi / 180);
        const Vec2 corner{x - c * length / 2 + s * width / 2, y - s * length / 2 - c * width / 2};
        return gondola(id, corner, length, width, {0.4, high / 2 + 0.3, high}, turn,
                       {Face::front, Face::back});
      }
    }
  }

  void add_units(Store& store, double width, double depth) {
    Store with_one = store;
    add_unit(with_one, "T", {0.3, 5.5, 2});
    const Scene empty = make_scene(with_one);
    while (store.transceivers.size() < 8) {
      const Vec2 plan{between(0.2, width - 0.2), between(0.2, depth - 0.2)};
      if (!is_free(store.room->shape, plan, 0.2)) continue;
      const double ceiling = store.room->shape.ceiling_over(plan).at(plan);
      const double z = one_of(4) ? between(1.2, ceiling - 0.1) : ceiling - between(0.05, 0.3);
      const bool is_blocked = std::ranges::any_of(empty.fixtures, [&](const FixtureOutline& fixture) {
        return z < fixture.height + 0.05 &&
               (contains(fixture.footprint, plan) || distance_to_border(fixture.footprint, plan) < 0.05);
      });
      if (!is_blocked)
        add_unit(store, fmt::format("T{}", store.transceivers.size() + 1), {plan[0], plan[1], z});
    }
  }

  std::mt19937_64 random_;
};

using Edge = std::pair<Vec2, Vec2>;

struct Line {
  double metres = 0;
  std::string arrow, name;
};

struct Row {
  std::string id;
  Line across, along;
  double height = 0;  // m
};

std::string inner_text(const std::string& html) {
  return std::regex_replace(html, std::regex("<[^>]*>"), "");
}

Line line_of(const std::string& text) {
  std::smatch found;
  if (!std::regex_match(text, found, std::regex("(\\d+) cm (\\S+) (.*)"))) return {};
  return {std::stod(found[1]) / 100, found[2], found[3]};
}

// The rows of the sheet by the headings of their cells, as a reader of the page finds them.
std::vector<Row> rows_of(const std::string& page) {
  const std::size_t begin = page.find("<table class=\"cards sheet\"");
  const std::string table = page.substr(begin, page.find("</table>", begin) - begin);
  const std::regex row("<tr>(.*?)</tr>"), cell("<td data-label=\"([^\"]*)\"[^>]*>(.*?)</td>");
  std::vector<Row> rows;
  for (std::sregex_iterator r(table.begin(), table.end(), row), end; r != end; ++r) {
    const std::string cells = (*r)[1];
    std::map<std::string, std::string> texts;
    for (std::sregex_iterator c(cells.begin(), cells.end(), cell); c != end; ++c)
      texts[(*c)[1]] = inner_text((*c)[2]);
    if (texts.empty()) continue;  // the head
    rows.push_back({texts.at("Unit"), line_of(texts.at("← →")), line_of(texts.at("↑ ↓")),
                    std::stod(texts.at("Height")) / 100});
  }
  return rows;
}

void add_edges(std::vector<Edge>& edges, std::span<const Vec2> polygon) {
  for (std::size_t k = 0; k < polygon.size(); ++k)
    edges.emplace_back(polygon[k], polygon[(k + 1) % polygon.size()]);
}

void add_walls(std::vector<Edge>& edges, const Scene& scene) {
  add_edges(edges, scene.room->outline);
  for (const Polygon& hole : scene.room->holes) add_edges(edges, hole);
}

// Surfaces at a height: what a fitter sees there, of one fixture or of all.
void add_parts(std::vector<Edge>& edges, const Scene& scene, double height, const std::string& id = {}) {
  for (const Part& part : scene.parts)
    if (part.kind != PartKind::shell && part.bottom <= height && height <= part.top &&
        (id.empty() || scene.fixtures[part.fixture].id == id))
      add_edges(edges, part.footprint);
}

struct NamedEdges {
  std::vector<Edge> edges;
  bool is_seen = true;  // at the height of the unit
};

NamedEdges edges_named(const Scene& scene, const std::string& name, double height) {
  NamedEdges named;
  if (name == "wall") {
    add_walls(named.edges, scene);
  } else if (name.starts_with("edge of the ceiling")) {
    for (const CeilingZone& zone : scene.room->zones) add_edges(named.edges, zone.polygon);
  } else {
    const std::size_t side = name.find(" side of ");
    const std::string id = side == std::string::npos ? name : name.substr(side + 9);
    if (side == std::string::npos) add_parts(named.edges, scene, height, id);
    named.is_seen = !named.edges.empty();
    if (!named.is_seen)
      for (const FixtureOutline& fixture : scene.fixtures)
        if (fixture.id == id) add_edges(named.edges, fixture.footprint);
  }
  return named;
}

Vec2 step_of(const Line& line) {
  const double d = line.metres;
  if (line.arrow == "←") return {-d, 0};
  if (line.arrow == "→") return {d, 0};
  return line.arrow == "↓" ? Vec2{0, -d} : Vec2{0, d};
}

double side(const Edge& edge, const Vec2& p) {
  const auto& [a, b] = edge;
  return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

// Whether a point on the line of an edge belongs to the edge, within 2 cm.
bool is_on(const Edge& edge, const Vec2& p) {
  const auto& [a, b] = edge;
  const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
  const double along = ((p[0] - a[0]) * (b[0] - a[0]) + (p[1] - a[1]) * (b[1] - a[1])) / length;
  return along > -0.02 && along < length + 0.02;
}

bool is_clear(const std::vector<Edge>& surfaces, const Vec2& from, const Vec2& step) {
  const double length = std::hypot(step[0], step[1]), share = (length - 0.03) / length;
  const Edge way{from, {from[0] + share * step[0], from[1] + share * step[1]}};
  if (length < 0.03) return true;
  for (const Edge& edge : surfaces)
    if (side(edge, way.first) * side(edge, way.second) < 0 &&
        side(way, edge.first) * side(way, edge.second) < 0)
      return false;
  return true;
}

// The position from which both surfaces are as far as the row says. Of several, the one nearest to the mark
// on the drawing, which shows a position to half a metre.
std::optional<Vec2> position_by(const Scene& scene, const Row& row, const Vec2& mark) {
  std::vector<Edge> surfaces;
  add_walls(surfaces, scene);
  add_parts(surfaces, scene, row.height);
  const NamedEdges first = edges_named(scene, row.across.name, row.height);
  const NamedEdges second = edges_named(scene, row.along.name, row.height);
  const Vec2 to_first = step_of(row.across), to_second = step_of(row.along);
  std::optional<Vec2> best;
  double least = 1;  // m
  for (const Edge& a : first.edges)
    for (const Edge& b : second.edges) {
      // p + to_first lies on the line of a, and p + to_second on that of b.
      const auto normal = [](const Edge& e) {
        return Vec2{e.first[1] - e.second[1], e.second[0] - e.first[0]};
      };
      const Vec2 m = normal(a), n = normal(b);
      const double ra = m[0] * (a.first[0] - to_first[0]) + m[1] * (a.first[1] - to_first[1]);
      const double rb = n[0] * (b.first[0] - to_second[0]) + n[1] * (b.first[1] - to_second[1]);
      const double det = m[0] * n[1] - m[1] * n[0];
      if (std::abs(det) < 1e-9) continue;
      const Vec2 p{(ra * n[1] - m[1] * rb) / det, (m[0] * rb - ra * n[0]) / det};
      if (!is_on(a, {p[0] + to_first[0], p[1] + to_first[1]}) ||
          !is_on(b, {p[0] + to_second[0], p[1] + to_second[1]}))
        continue;
      if ((first.is_seen && !is_clear(surfaces, p, to_first)) ||
          (second.is_seen && !is_clear(surfaces, p, to_second)))
        continue;
      const double distance = std::hypot(p[0] - mark[0], p[1] - mark[1]);
      if (distance < least) {
        least = distance;
        best = p;
      }
    }
  return best;
}

constexpr double allowed = 0.02;  // m

// The units that are not where the sheet says.
int misplaced(const Scene& scene, const std::vector<Row>& rows, unsigned seed) {
  RandomShop random(seed);
  int count = 0;
  for (const Row& row : rows)
    for (const Transceiver& unit : scene.transceivers) {
      if (unit.id != row.id) continue;
      const auto& [x, y, z] = unit.position;
      const Vec2 mark{x + random.between(-0.5, 0.5), y + random.between(-0.5, 0.5)};
      const auto found = position_by(scene, row, mark);
      const bool is_right = found && std::hypot((*found)[0] - x, (*found)[1] - y) <= allowed &&
                            std::abs(row.height - z) <= allowed;
      if (!is_right) ++count;
    }
  return count;
}

// All units are chosen.
PlannedShop planned(unsigned seed) {
  PlannedShop shop(RandomShop(seed).store());
  shop.placement.status = Status::optimal;
  shop.placement.unreachable.clear();
  shop.placement.selected.clear();
  for (std::uint32_t j = 0; j < shop.matrix.columns(); ++j) shop.placement.selected.push_back(j);
  return shop;
}

std::vector<Row> sheet_of(const PlannedShop& shop) {
  const ReportData data(shop.input);
  return rows_of(mounting_section(data, Maps(data)));
}

TEST(Mountable, EveryUnitOfRandomShopsIsFoundByItsDistances) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const PlannedShop shop = planned(seed);
    const std::vector<Row> rows = sheet_of(shop);
    ASSERT_EQ(rows.size(), shop.scene.transceivers.size()) << seed;
    EXPECT_EQ(misplaced(shop.scene, rows, 100 + seed), 0) << seed;
  }
}

TEST(Mountable, IsNotSoByWrongDistances) {
  const PlannedShop shop = planned(1);
  const std::vector<Row> rows = sheet_of(shop);
  const auto misplaced_after = [&](const auto& change) {
    std::vector<Row> wrong = rows;
    for (Row& row : wrong) change(row);
    return misplaced(shop.scene, wrong, 101);
  };
  const int all = static_cast<int>(rows.size());
  EXPECT_EQ(misplaced_after([](Row&) {}), 0);
  EXPECT_EQ(misplaced_after([](Row& row) { row.across.metres += 0.04; }), all);
  EXPECT_EQ(misplaced_after([](Row& row) { row.along.metres += 0.04; }), all);
  EXPECT_EQ(misplaced_after([](Row& row) { row.height += 0.03; }), all);
  EXPECT_EQ(misplaced_after([](Row& row) { row.across.name = "F99"; }), all);
}

}  // namespace
}  // namespace shelfbeam::test
