#include "shelfbeam/report/data/label_names.hpp"

#include "shelfbeam/report/difference/difference_report.hpp"

#include "support/processor_time.hpp"
#include "unit/report/shops.hpp"

namespace shelfbeam::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

struct NamedShop {
  Scene scene;
  SignalMatrix matrix;

  void add(const char* id, const char* description, const LabelPlace& place) {
    Label label;
    label.id = id;
    label.position = {1.5, 2.25, 1};
    label.description = description;
    label.place = place;
    scene.labels.push_back(label);
    LabelRow row;
    row.id = id;
    row.position = label.position;
    matrix.labels.push_back(row);
  }
  LabelNames names(Language language = Language::english) const { return {scene, matrix, Words(language)}; }
};

NamedShop named_shop() {
  NamedShop shop;
  shop.scene.room = RoomShape::box({10, 8, 3});
  shop.add("4001", "Rye bread", {.fixture = "G3", .face = Face::back, .board = 2, .along = 1.25});
  shop.add("4002", "", {.fixture = "G3", .face = Face::front, .board = 1, .along = 0.5});
  shop.add("G3-front-1-2", "", {.fixture = "G3", .face = Face::front, .board = 1, .along = 1});
  shop.add("4003", "Apples", {.fixture = "T1", .on_top = true});
  shop.add("4004", "Offers", {.wall = 2});
  shop.add("4005", "", {});
  shop.add("poster", "", {});
  shop.add("4006", "Milk", {.fixture = "C2", .face = Face::front, .along = 0.2});
  return shop;
}

TEST(LabelNames, AreArticlesAndPlaces) {
  const NamedShop named = named_shop();
  EXPECT_THAT(named.names().all(),
              ElementsAre("Rye bread (G3 back, board 2)", "G3 front, board 1, at 0.50 m",
                          "G3 front, board 1, at 1.00 m", "Apples (on top of T1)", "Offers (wall at the top)",
                          "label at 1.50, 2.25 m, 1.00 m high", "poster", "Milk (C2)"));
  EXPECT_THAT(named.names(Language::german).all(),
              ElementsAre("Rye bread (G3 hinten, Boden 2)", "G3 vorn, Boden 1, bei 0,50 m",
                          "G3 vorn, Boden 1, bei 1,00 m", "Apples (auf T1)", "Offers (obere Wand)",
                          "Etikett bei 1,50; 2,25 m, 1,00 m hoch", "poster", "Milk (C2)"));
}

TEST(LabelNames, CountManyLabelsByFixture) {
  const NamedShop named = named_shop();
  const LabelNames names = named.names();
  EXPECT_THAT(names.counts(std::vector<LabelId>{7, 0, 2}), ElementsAre("G3: 2 of 3", "C2: 1 of 1"));
  EXPECT_EQ(names.list(std::vector<LabelId>{7, 4}), "Milk (C2); Offers (wall at the top)");
  EXPECT_EQ(names.list(std::vector<LabelId>{7, 4, 2, 1, 0}), "3 on G3, 1 on wall at the top, 1 on C2");
  EXPECT_EQ(named.names(Language::german).list(std::vector<LabelId>{7, 6, 4, 2, 1}),
            "2× G3, 1× obere Wand, 1× andere Stellen, 1× C2");
  EXPECT_EQ(names.list(std::vector<LabelId>{7, 6, 4, 3, 2, 1, 0}),
            "3 on G3, 1 on T1, 1 on wall at the top, 1 on other places and others");
}

TEST(LabelNames, AreCountedInProportionToTheLabelsAskedFor) {
  NamedShop shop;
  for (std::size_t k = 0; k < 20'000; ++k)
    shop.add(fmt::format("{}", k).c_str(), "Sweets", {.fixture = fmt::format("G{}", k % 50)});
  const LabelNames names = shop.names();
  const ProcessorTime time;
  for (std::uint32_t row = 0; row < 1000; ++row)
    EXPECT_EQ(names.counts(std::vector<LabelId>{row}).front(), fmt::format("G{}: 1 of 400", row % 50));
  EXPECT_LT(time.seconds(), 0.3);  // 2 s when all labels were counted each time
}

// Labels of a planogram: article numbers as ids.
void give_articles(PlannedShop& s) {
  for (std::size_t k = 0; k < s.scene.labels.size(); ++k) {
    s.scene.labels[k].id = s.matrix.labels[k].id = fmt::format("40011700{:05}", k);
    s.scene.labels[k].description = fmt::format("Sweets {}", k);
  }
}

// Texts with an article number that its description does not precede, except cells of its own.
std::vector<std::string> bare_numbers(const Page& page) {
  constexpr std::size_t digits = 13, name_length = 45;
  std::vector<std::string> found;
  for (const std::string& piece : page.cells)
    for (std::size_t at = 0; (at = piece.find("40011700", at)) != std::string::npos; at += digits) {
      const std::size_t from = at - std::min(at, name_length);
      if (piece.size() != digits && piece.substr(from, at - from).find("Sweets ") == std::string::npos)
        found.push_back(piece);
    }
  return found;
}

TEST(LabelNames, PrecedeArticleNumbers) {
  Supermarket s;
  give_articles(s);
  certify(s);
  s.scene.language = Language::german;
  const Page page(s.input);
  EXPECT_THAT(bare_numbers(page), IsEmpty());
  EXPECT_THAT(bare_numbers(Page("<p>label 4001170000012 is weak</p>")), testing::SizeIs(1)) << "the control";
  EXPECT_THAT(bare_numbers(Page("<p>Sweets 3, 4001170000003: 4001170000012</p>")), IsEmpty());
  // An article number has a cell of its own only in the table of the weakest labels, after the name.
  std::size_t cells = 0;
  for (std::size_t at = 0; (at = page.html.find("40011700", at)) != std::string::npos; ++at, ++cells) {
    const std::size_t row = page.html.rfind("<tr>", at);
    EXPECT_NE(page.html.substr(row, at - row).find("Sweets "), std::string::npos) << page.html.substr(at, 40);
  }
  EXPECT_EQ(cells, 20U);
  EXPECT_NE(labels_csv(s.input).find(",Sweets 0,"), std::string::npos);
}

// An article twice on a board: two labels with the same name.
TEST(LabelNames, LeaveIdsInTablesWithoutPositions) {
  Kiosk s;
  give_articles(s);
  for (std::size_t k = 5; k < 9; ++k) {
    s.scene.labels[k].description = "Sweets";
    s.scene.labels[k].place = {.fixture = "A1", .face = Face::front, .board = 1};
  }
  const auto id = [&](std::uint32_t row) { return s.matrix.labels[row].id; };
  const auto both = [&](const Page& page) { return page.cells.count(id(7)) + page.cells.count(id(8)); };
  const Page before(s.input);
  Sensitivity& sensitivity = s.plan.sensitivity.emplace();
  MaterialSensitivity grey{"grey", 0.6, 0.45, 0.75, false, {}, {}};
  grey.at_lower.min_margin = {0.8, 0.008, 5};
  grey.at_upper.min_margin = {1.6, 0.008, 6};
  sensitivity.materials = {grey};
  sensitivity.low.min_margin = sensitivity.high.min_margin = {0.8, 0.008, 5};
  const Page with_reflectances(s.input);
  EXPECT_EQ(with_reflectances.cells.count(id(5)), before.cells.count(id(5)) + 1);
  EXPECT_TRUE(with_reflectances.has(", " + id(6) + ")")) << "the bar of the chart";
  Availability& availability = s.plan.availability.emplace();
  availability.required.assign(s.matrix.rows(), 0.9);
  availability.examined = {{2, 10, std::vector<std::uint32_t>(s.matrix.rows(), 2), 10}};
  availability.at_risk = {{7, {}}, {8, {}}};
  EXPECT_EQ(both(Page(s.input)), both(before) + 2);
  s.plan.placement.unreachable = {{7, 1, 0.5}, {8, 1, 0.5}};
  EXPECT_EQ(both(Page(s.input)), both(before) + 4);
}

/// A rack with articles, one of them in a locker.
PlannedShop bakery(double shift = 0) {
  Store store = empty_store("Bakery", {12, 10, 3});
  store.language = Language::german;
  add(store, gondola("G3", {5, 5}, 3, 0.8, {0.4, 1.2}, 0, {Face::front}));
  add(store, Box{"locker", {1, 1, 0}, {2, 2, 1}, {}});
  add_devices(store, {5, 4.9, 1.2}, {6, 3, 2.9});
  add_label(store, "4001170000001", {6 + shift, 4.99, 0.4});
  add_label(store, "4001170000002", {1.5, 1.5, 0.5});
  for (const std::size_t k : {1U, 2U}) {
    store.labels[k].value.description = fmt::format("Sweets {}", k);
    store.labels[k].where = fmt::format("q.csv: line {}", k + 1);
  }
  PlannedShop shop(store);
  shop.plan.warnings = shop.scene.warnings;
  return shop;
}

TEST(LabelNames, PrecedeArticleNumbersInWarnings) {
  const Page page(bakery().input);
  EXPECT_TRUE(page.has_text("q.csv: line 3: label 'Sweets 2' (4001170000002) is inside fixture 'locker'"));
  EXPECT_THAT(bare_numbers(page), IsEmpty());
}

TEST(LabelNames, PrecedeArticleNumbersInDifferences) {
  const auto compared = [](const PlannedShop& shop) {
    ComparedPlan plan = compared_plan(shop.matrix, shop.plan, resolved_store_json(shop.store, shop.scene));
    plan.label_names = LabelNames(shop.scene, shop.matrix, words_of(shop.scene)).all();
    return plan;
  };
  const PlannedShop before = bakery(), after = bakery(0.5);
  const ComparedPlan first = compared(before), second = compared(after);
  const PlanDifference difference = difference_of(first, second);
  const Page page(difference_html({{first, second, difference}, after.scene, "1", "2"}));
  EXPECT_TRUE(page.has("Sweets 1 (4001170000001): position [6.5, 4.99, 0.4]"));
  EXPECT_THAT(bare_numbers(page), IsEmpty());
}

}  // namespace
}  // namespace shelfbeam::test
