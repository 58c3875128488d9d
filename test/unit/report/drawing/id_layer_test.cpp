#include "shelfbeam/report/drawing/id_layer.hpp"

#include <regex>

#include "shelfbeam/report/drawing/store_layer.hpp"

#include "support/processor_time.hpp"
#include "unit/report/shops.hpp"

namespace shelfbeam::test {
namespace {

struct DrawnText {
  std::string text, css_class;
  double x = 0, y = 0, size = 0;

  Rectangle area() const {
    const double half = text_width(text, size) / 2, middle = y - 0.35 * size;
    return {x - half, middle - size / 2, x + half, middle + size / 2};
  }
};

// A room with a column, a pillar that is turned by 45 degrees, and a low block; candidates every `spacing`.
Store shop(double spacing) {
  Store store = empty_store("Columns", {20, 12, 4});
  add(store, Cylinder{"round", {5, 6}, 0.4, {0, 4}, {}});
  Box turned{"turned", {10, 6, 0}, {10.6, 6.6, 4}, {}};
  turned.rotation_deg = 45;
  add(store, turned);
  add(store, Box{"low", {15, 6, 0}, {16, 7, 1}, {}});
  add_label(store, "L", {1, 1, 1});
  const auto count = [&](double extent) { return static_cast<int>(std::ceil((extent - 0.5) / spacing)); };
  for (int column = 0; column < count(20); ++column)
    for (int row = 0; row < count(12); ++row) {
      const double x = 0.5 + column * spacing, y = 0.5 + row * spacing;
      add_unit(store, fmt::format("C{:.0f}-{:.0f}", 10 * x, 10 * y), {x, y, 3.9});
    }
  return store;
}

std::vector<DrawnText> layer_of(const Scene& scene, const std::vector<Obstacle>& texts = {}) {
  SvgCanvas canvas;
  draw_id_layer(canvas, PlanView(scene), scene, texts);
  const std::string& body = canvas.body();
  EXPECT_EQ(read_markup(body).problem, "");
  const std::regex text(
      R"re(font-size:([0-9.]+)px"><text x="([0-9.]+)" y="([0-9.]+)" class="([a-z]+)">([^<]*)</text>)re");
  std::vector<DrawnText> drawn;
  for (std::sregex_iterator it(body.begin(), body.end(), text), end; it != end; ++it)
    drawn.push_back({(*it)[5], (*it)[4], std::stod((*it)[2]), std::stod((*it)[3]), std::stod((*it)[1])});
  return drawn;
}

std::size_t overlaps(const std::vector<DrawnText>& texts, double enlarged = 1) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < texts.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      DrawnText a = texts[i], b = texts[j];
      a.size *= 0.98 * enlarged;  // coordinates are rounded
      b.size *= 0.98 * enlarged;
      count += a.area().meets(b.area()) ? 1 : 0;
    }
  return count;
}

TEST(IdLayer, HasEveryCandidateWithoutOverlaps) {
  for (const double spacing : {2.0, 1.0, 0.5}) {
    const Scene scene = make_scene(shop(spacing));
    const std::vector<DrawnText> texts = layer_of(scene);
    std::map<std::string, int> count;
    for (const DrawnText& text : texts) ++count[text.text];
    for (const Transceiver& unit : scene.transceivers) EXPECT_EQ(count[unit.id], 1) << unit.id;
    EXPECT_EQ(overlaps(texts), 0U) << spacing;
    EXPECT_GT(overlaps(texts, 6), 0U) << "negative control: larger texts overlap";
    const PlanView view(scene);
    for (const DrawnText& text : texts)
      for (const Transceiver& unit : scene.transceivers) {
        const Point at = view.at(unit.position.x, unit.position.y);
        const Rectangle mark{at.x - 4, at.y - 4, at.x + 4, at.y + 4};
        EXPECT_FALSE(mark.meets(text.area())) << text.text << " covers " << unit.id;
      }
  }
}

TEST(IdLayer, NamesTheFacesOfColumnsByTheCompass) {
  const Scene scene = make_scene(shop(2));
  const PlanView view(scene);
  std::map<std::string, std::vector<DrawnText>> faces;
  for (const DrawnText& text : layer_of(scene))
    if (text.css_class == "face") faces[text.text].push_back(text);
  // The turned pillar has no face by the compass, and the block is not a column.
  for (const char* name : {"N", "E", "S", "W"}) ASSERT_EQ(faces[name].size(), 1U) << name;
  const Point middle = view.at(5, 6);
  const double radius = 0.4 * view.scale();
  EXPECT_NEAR(faces["N"][0].x, middle.x, 0.2);
  EXPECT_LT(faces["N"][0].y, middle.y - radius);
  EXPECT_GT(faces["S"][0].area().top, middle.y + radius - 1);
  EXPECT_GT(faces["E"][0].x, middle.x + radius);
  EXPECT_LT(faces["W"][0].x, middle.x - radius);
}

TEST(IdLayer, JoinsTheIdsAtOnePoint) {
  Store store = shop(100);
  for (const char* id : {"A1-1-1/a1", "A1-1-1/a2", "A1-1-1/a3"}) add_unit(store, id, {8, 2, 3.9});
  add_unit(store, "G1-1-1", {14, 2, 3.9});
  add_unit(store, "low", {14, 2, 2});
  std::vector<std::string> ids;
  for (const DrawnText& text : layer_of(make_scene(store)))
    if (text.css_class == "cid") ids.push_back(text.text);
  EXPECT_EQ(ids, (std::vector<std::string>{"C5-5", "A1-1-1/a1-3", "G1-1-1 +1"}));
}

TEST(IdLayer, KeepsClearOfOtherTexts) {
  const Scene scene = make_scene(shop(100));
  const auto before = layer_of(scene);
  const auto candidate = std::ranges::find(before, std::string("cid"), &DrawnText::css_class);
  ASSERT_NE(candidate, before.end());
  const Obstacle text(candidate->area());
  for (const DrawnText& after : layer_of(scene, {text})) EXPECT_FALSE(text.meets(after.area())) << after.text;
  EXPECT_TRUE(text.meets(candidate->area())) << "negative control";
}

TEST(IdLayer, IsInThePlanOnlyIfAskedFor) {
  const Scene scene = make_scene(shop(2));
  const std::string without = floor_plan_svg(scene), with = floor_plan_svg(scene, true);
  EXPECT_EQ(without.find("id=\"ids\""), std::string::npos);
  EXPECT_EQ(without.find(".cid"), std::string::npos);
  EXPECT_EQ(count_of("<g id=\"ids\">", with), 1U);
  EXPECT_NE(with.find(".cid{"), std::string::npos);
  EXPECT_EQ(read_markup(with).problem, "");
}

TEST(IdLayer, IsDrawnAsFastWithManyTextsElsewhere) {
  const Scene scene = make_scene(shop(0.25));
  const std::vector<Obstacle> elsewhere(20'000, Obstacle(Rectangle{1, 1, 2, 2}));
  const ProcessorTime time;
  EXPECT_EQ(layer_of(scene, elsewhere).size(), layer_of(scene).size());
  EXPECT_LT(time.seconds(), 1);
}

}  // namespace
}  // namespace shelfbeam::test
