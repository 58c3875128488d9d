#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "shelfbeam/report/data/report.hpp"
#include "shelfbeam/report/drawing/part_drawing.hpp"

#include "unit/report/markup.hpp"
#include "unit/report/sample_store.hpp"

namespace shelfbeam {
namespace {

TEST(FloorPlan, IsWellFormedAndHasALegend) {
  const Scene scene = make_scene(sample_store::supermarket());
  const std::string svg = floor_plan_svg(scene);
  const test::Markup markup = test::read_markup(svg);
  EXPECT_EQ(markup.problem, "");
  for (const FixtureOutline& fixture : scene.fixtures)
    EXPECT_NE(markup.text.find(fixture.id), std::string::npos) << fixture.id;
  EXPECT_NE(markup.text.find("25 × 18 × 4 m · 14 fixtures · 926 labels"), std::string::npos);
  for (const char* part : {"panel", "board", "kick", "tub", "solid"})
    EXPECT_TRUE(std::any_of(markup.elements.begin(), markup.elements.end(), [&](const auto& element) {
      const auto css = element.attributes.find("class");
      return css != element.attributes.end() && css->second == part;
    })) << part;
  EXPECT_EQ(svg, floor_plan_svg(scene));
}

TEST(FloorPlan, DrawsAMountingPointOnce) {
  Store store = sample_store::kiosk();
  const auto crosses = [&] {
    std::size_t count = 0;
    for (const auto& element : test::read_markup(floor_plan_svg(make_scene(store))).elements) {
      const auto css = element.attributes.find("class"), data = element.attributes.find("d");
      if (css == element.attributes.end() || css->second != "cand" || data == element.attributes.end())
        continue;
      const auto& d = data->second;
      // Each cross has one M, including the one in the key.
      count += static_cast<std::size_t>(std::count(d.begin(), d.end(), 'M'));
    }
    return count;
  };
  const auto has = [&](const char* text) {
    return floor_plan_svg(make_scene(store)).find(text) != std::string::npos;
  };
  EXPECT_EQ(crosses(), 2U + 1);  // two candidates and an installed unit
  EXPECT_FALSE(has("mounting point"));
  Transceiver option = store.transceivers[0].value;
  option.id = "option";
  option.axis = {1, 0, 0};
  store.transceivers.push_back({option, "list"});
  option.id = "where one is installed";
  option.position = store.transceivers[1].value.position;
  store.transceivers.push_back({option, "list"});
  EXPECT_EQ(crosses(), 2U + 1);
  EXPECT_TRUE(has("5 candidate transceivers at 3 mounting points"));
  store.transceivers.back().value.position.x -= 0.01;
  EXPECT_EQ(crosses(), 3U + 1);
}

TEST(FloorPlan, ShowsWhichWayAUnitLeans) {
  Store store = sample_store::kiosk();
  const auto has = [&](const char* text) {
    return floor_plan_svg(make_scene(store)).find(text) != std::string::npos;
  };
  EXPECT_FALSE(has("class=\"aim\"") || has("tilted this way"));
  store.transceivers[0].value.axis = {0, 0.6, -0.8};
  EXPECT_TRUE(has("l0 -12\" class=\"aim\"") && has("tilted this way"));  // north is up
}

// Two blocks that form an L: the plan fills the L, not its hull. Each block is seen as its top and its
// bottom, whose triangles have opposite orientations in the mesh.
TEST(FloorPlan, DrawsAMeshAsItIs) {
  Store store = sample_store::kiosk();
  MeshFixture mesh{"L", {0.5, 0.5, 0}, 0, 1, {{"m", {}, {}, {}}}};
  for (const auto& [x, y] : {std::array{2.0, 0.5}, {0.5, 2.0}}) {
    const auto first = static_cast<std::uint32_t>(mesh.pieces[0].vertices.size());
    for (const double z : {0.0, 1.0})
      for (const Vec3& corner : {Vec3{0, 0, z}, Vec3{x, 0, z}, Vec3{x, y, z}, Vec3{0, y, z}})
        mesh.pieces[0].vertices.push_back(corner);
    for (const auto& [a, b, c] : {std::array{0U, 2U, 1U}, {0U, 3U, 2U}, {4U, 5U, 6U}, {4U, 6U, 7U}})
      mesh.pieces[0].triangles.push_back({first + a, first + b, first + c});
  }
  store.fixtures.push_back({mesh, "fixtures"});
  const Scene scene = make_scene(store);
  const PlanView view(scene);
  const std::string data = mesh_silhouette(view, scene, 1U);
  double area = 0, least = 1;
  std::size_t triangles = 0;
  for (std::size_t at = 0; at < data.size(); at = data.find('Z', at) + 1, ++triangles) {
    std::array<double, 6> p{};
    std::sscanf(data.c_str() + at, "M%lf %lfL%lf %lfL%lf %lf", &p[0], &p[1], &p[2], &p[3], &p[4], &p[5]);
    const double one =
        -((p[2] - p[0]) * (p[5] - p[1]) - (p[3] - p[1]) * (p[4] - p[0])) / 2 / view.scale() / view.scale();
    area += one;
    least = std::min(least, one);
  }
  EXPECT_EQ(triangles, 8U);
  EXPECT_GT(least, 0) << "turned another way, it would be a hole";
  EXPECT_NEAR(area, 2 * 2 * 2 * 0.5, 0.01);  // m^2; a tenth of a drawing unit is below 1 mm here
  const std::string svg = floor_plan_svg(scene);
  EXPECT_EQ(test::count_of("class=\"mesh\"", svg), 1U);
  EXPECT_EQ(test::count_of("class=\"outline\"", svg), 1U)
      << "of the gondola; of the mesh it would be the hull";
  EXPECT_EQ(mesh_silhouette(view, scene, 0U), "");
}

TEST(FloorPlan, ShowsDoors) {
  Store store = sample_store::kiosk();
  const auto drawn = [&](const std::string& css_class) {
    const auto elements = test::read_markup(floor_plan_svg(make_scene(store))).elements;
    return std::count_if(elements.begin(), elements.end(), [&](const auto& element) {
      const auto css = element.attributes.find("class");
      return css != element.attributes.end() && css->second == css_class;
    });
  };
  EXPECT_EQ(drawn("door"), 0);
  auto& gondola = std::get<Gondola>(store.fixtures[0].value);
  gondola.doors = gondola.material;
  // One per face with boards in the plan, and two in the elevation.
  EXPECT_EQ(drawn("door"), 3 * static_cast<std::ptrdiff_t>(gondola.faces.size()));
  EXPECT_GT(drawn("casing"), 0);
}

TEST(FloorPlan, EscapesNames) {
  const std::string svg = floor_plan_svg(make_scene(sample_store::kiosk()));
  const test::Markup markup = test::read_markup(svg);
  EXPECT_EQ(markup.problem, "");
  EXPECT_NE(markup.text.find("Joe's <Kiosk> & \"Bar\""), std::string::npos);
  EXPECT_EQ(svg.find("<Kiosk>"), std::string::npos);
}

TEST(FloorPlan, DrawsFromLowToHighAndOmitsHiddenParts) {
  const Scene scene = make_scene(sample_store::supermarket());
  const auto seen = parts_seen_from_above(scene);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end(),
                             [&](auto a, auto b) { return scene.parts[a].top < scene.parts[b].top; }));
  std::size_t goods = 0, hidden = 0;
  for (std::uint32_t k = 0; k < scene.parts.size(); ++k) {
    if (std::find(seen.begin(), seen.end(), k) != seen.end()) {
      goods += scene.parts[k].kind == PartKind::goods ? 1 : 0;
      continue;
    }
    ++hidden;
    // Each corner of a hidden part is below a board of its fixture: inside the board's outline, with a margin
    // of 1 nm for the rounding of a rotated corner.
    const bool covered = std::any_of(scene.parts.begin(), scene.parts.end(), [&](const Part& board) {
      if (board.kind != PartKind::board || board.fixture != scene.parts[k].fixture) return false;
      if (board.bottom < scene.parts[k].top - 1e-6) return false;
      const auto& o = board.footprint;
      return std::all_of(scene.parts[k].footprint.begin(), scene.parts[k].footprint.end(),
                         [&](const auto& p) {
                           for (std::size_t e = 0; e < o.size(); ++e) {
                             const auto& a = o[e];
                             const auto& b = o[(e + 1) % o.size()];
                             if ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) < -1e-6)
                               return false;
                           }
                           return true;
                         });
    });
    EXPECT_TRUE(covered) << k;
  }
  EXPECT_GT(goods, 200U);
  EXPECT_GT(hidden, 500U);
}

TEST(Elevation, ShowsTheFixtureWithMostLabels) {
  const Scene scene = make_scene(sample_store::supermarket());
  const auto fixture = fixture_with_max_labels(scene);
  ASSERT_TRUE(fixture);
  std::vector<std::size_t> counts;
  for (const FixtureOutline& outline : scene.fixtures)
    counts.push_back(static_cast<std::size_t>(
        std::count_if(scene.labels.begin(), scene.labels.end(),
                      [&](const Label& label) { return label.id.starts_with(outline.id + "-"); })));
  EXPECT_EQ(counts[*fixture], *std::max_element(counts.begin(), counts.end()));
  EXPECT_GT(counts[*fixture], *std::min_element(counts.begin(), counts.end()));

  SvgCanvas canvas;
  EXPECT_GT(draw_elevation(canvas, scene, *fixture, 0, 1000), 100);
  std::size_t tags = 0;
  for (const auto& element : test::read_markup(canvas.body()).elements) {
    const auto css = element.attributes.find("class");
    tags += css != element.attributes.end() && css->second == "tag" ? 1 : 0;
  }
  EXPECT_EQ(tags, counts[*fixture]);  // wall shelving: all its labels face the viewer
}

TEST(Elevation, IsMissingWithoutLabelsOnFixtures) {
  Store store = sample_store::kiosk();
  std::get<Gondola>(store.fixtures[0].value).labels.reset();
  store.labels.push_back({Label{"L", {0.5, 0.5, 1}, {1, 0, 0}, {}}, "list"});
  const Scene scene = make_scene(store);
  EXPECT_FALSE(fixture_with_max_labels(scene));
  EXPECT_EQ(test::read_markup(floor_plan_svg(scene)).problem, "");
}

}  // namespace
}  // namespace shelfbeam
