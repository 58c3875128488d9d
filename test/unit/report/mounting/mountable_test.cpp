// Every unit of random shops can be mounted by the sheet of the page alone.

#include <cmath>
#include <map>
#include <optional>
#include <regex>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/report/data/report.hpp"
#include "shelfbeam/report/text/words.hpp"

#include "unit/report/random_shop.hpp"
#include "unit/report/supermarket_report.hpp"

namespace shelfbeam {
namespace {

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
int misplaced(const Scene& scene, const std::vector<Row>& rows, test::RandomShop& random) {
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

struct Planned {
  explicit Planned(unsigned seed) : scene(make_scene(test::RandomShop(seed).store())) {
    plan.placement = sample_store::cover(matrix);
    plan.placement.status = Status::optimal;
    plan.placement.unreachable.clear();
    plan.placement.selected.clear();
    for (std::uint32_t j = 0; j < matrix.columns(); ++j) plan.placement.selected.push_back(j);
  }

  Scene scene;
  SignalMatrix matrix = sample_store::matrix_of(scene);
  CertifiedPlan plan;
  ReportInput input{scene, matrix, plan};
};

TEST(Mountable, EveryUnitOfRandomShopsIsFoundByItsDistances) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Planned shop(seed);
    const std::vector<Row> rows = rows_of(test::static_report(shop.input));
    ASSERT_EQ(rows.size(), shop.scene.transceivers.size()) << seed;
    test::RandomShop random(100 + seed);
    EXPECT_EQ(misplaced(shop.scene, rows, random), 0) << seed;
  }
}

TEST(Mountable, IsNotSoByWrongDistances) {
  const Planned shop(1);
  const std::vector<Row> rows = rows_of(test::static_report(shop.input));
  const auto misplaced_after = [&](const auto& change) {
    std::vector<Row> wrong = rows;
    for (Row& row : wrong) change(row);
    test::RandomShop random(101);
    return misplaced(shop.scene, wrong, random);
  };
  const int all = static_cast<int>(rows.size());
  EXPECT_EQ(misplaced_after([](Row&) {}), 0);
  EXPECT_EQ(misplaced_after([](Row& row) { row.across.metres += 0.04; }), all);
  EXPECT_EQ(misplaced_after([](Row& row) { row.along.metres += 0.04; }), all);
  EXPECT_EQ(misplaced_after([](Row& row) { row.height += 0.03; }), all);
  EXPECT_EQ(misplaced_after([](Row& row) { row.across.name = "F99"; }), all);
}

}  // namespace
}  // namespace shelfbeam
