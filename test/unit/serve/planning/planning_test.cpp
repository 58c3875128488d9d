#include "serve/planning/planning.hpp"

#include "serve/live/shop.hpp"
#include "unit/plan/plan_store.hpp"
#include "unit/serve/testing.hpp"

namespace shelfbeam::serve {
namespace {

constexpr auto placement_of_plan =
    R"({"count": 2, "count_lower_bound": 1, "labels": 16, "selected": ["T0-0", "T3-2"], "complete": true,
        "files": {}, "status": "optimal", "unreachable": [], "label_names": {"A1-front-1-1": "first"},
        "alternatives": {"one_more": {"count": 3, "selected": ["T0-0", "T1-1", "T3-2"]}},
        "certificate": {"count_lower_bound": 2, "missed": ["gone"], "undecided": ["A1-front-1-2", "A1-front-1-1"],
                        "not_verified_yet": []}})";

class PlanningOfAShop : public testing::Test {
 protected:
  PlanningOfAShop() : shop_(folder_.path() / "store.json") {
    fs::create_directory(folder_ / ".shelfbeam");
    folder_.write("plan/placement.json", placement_of_plan);
    folder_.write("plan/signal.h5", "secret");
    folder_.write("plan/report.html", "<h1>report</h1>");
    folder_.write("plan/mounting.csv", "id\n");
    folder_.write("plan/other.txt", "no file of a plan");
    folder_.write("other/report.html", "no plan");
    read(Json::parse(PlanStore().text()));
  }
  void read(const Json& store) { shop_.update(store.dump(), ++revision_); }
  Planning::News poll() { return planning_.poll(shop_.json(), shop_.draft(), revision_); }
  Json answer(Json json) {
    json["id"] = 1;
    const Request request{7, std::move(json)};
    return planning_.answer(request, shop_.json(), shop_.draft()).value();
  }

  TempFolder folder_;
  Shop shop_;
  std::uint64_t revision_ = 0;
  Planning planning_{folder_.path(), "/bin/false"};
};

TEST_F(PlanningOfAShop, SendsFilesOfPlansAlone) {
  EXPECT_FALSE(planning_.document("plans/1/report.html")) << "it is not in the list yet";
  const Planning::News news = poll();
  ASSERT_TRUE(news.event);
  EXPECT_EQ(news.event->at("set")[0].at("folder"), "plan");
  const auto report = planning_.document("plans/1/report.html");
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->is_report);
  EXPECT_EQ(report->type, "text/html; charset=utf-8");
  const auto sheet = planning_.document("plans/1/mounting.csv");
  ASSERT_TRUE(sheet);
  EXPECT_FALSE(sheet->is_report);
  for (const char* name : {"plans/1/signal.h5", "plans/1/other.txt", "plans/2/report.html",
                           "plans/1/labels.csv", "plans/1", "plans/", "plans//report.html",
                           "plans/1/../../store.json", "plans/../1/report.html", "difference", "scene"})
    EXPECT_FALSE(planning_.document(name)) << name;
  fs::remove(folder_ / "plan" / "report.html");
  fs::create_symlink("/etc/passwd", folder_ / "plan" / "report.html");
  EXPECT_FALSE(planning_.document("plans/1/report.html")) << "a link";
}

TEST_F(PlanningOfAShop, SelectsTheUnitsOfAnAlternative) {
  poll();
  const Planning::Selection more = planning_.selection(1, "one_more", shop_.json(), shop_.draft());
  EXPECT_EQ(more.label, "plan: 3 units");
  EXPECT_EQ(*more.ops.at(0).after, (Json{"T0-0", "T1-1", "T3-2"}));
  for (const char* other : {"one_fewer", "survives_failure", "none"})
    expect_input_error([&] { planning_.selection(1, other, shop_.json(), shop_.draft()); },
                       "has chosen no units");
}

TEST(RunProgress, KeepsTheBestBoundUntilAnIncumbentContradictsIt) {
  RunProgress now;
  now.take_bounds(9, 4, false);
  now.take_bounds(6, 6, false);
  EXPECT_EQ(now.bound, 6);
  now.take_bounds(6, 2, false);  // the proof begins anew
  EXPECT_EQ(now.bound, 6);
  now.take_bounds(5, 3, false);
  EXPECT_EQ(now.bound, 3);
  RunProgress labels;
  labels.take_bounds(100, 180, true);
  labels.take_bounds(120, 200, true);
  EXPECT_EQ(labels.bound, 180);
  labels.take_bounds(190, 200, true);
  EXPECT_EQ(labels.bound, 200);
  RunProgress prices;
  prices.selected = {"a", "b", "c"};
  prices.take_bounds(3.3, 2.9, false);
  prices.take_bounds(3, 2, false);  // numbers of units
  EXPECT_EQ(prices.bound, 2);
}

TEST_F(PlanningOfAShop, SelectsTheUnitsThatAreNotOnThePlanAnyway) {
  poll();
  const Planning::Selection first = planning_.selection(1, "", shop_.json(), shop_.draft());
  EXPECT_EQ(first.label, "plan: 2 units");
  ASSERT_EQ(first.ops.size(), 1U);
  EXPECT_EQ(first.ops[0].path, "/transceivers/selected");
  EXPECT_FALSE(first.ops[0].before);
  EXPECT_EQ(*first.ops[0].after, (Json{"T0-0", "T3-2"}));
  Json store = shop_.json();
  store["transceivers"]["pinned"] = {"T0-0"};
  store["transceivers"]["selected"] = {"T1-1"};
  read(store);
  const Planning::Selection second = planning_.selection(1, "", shop_.json(), shop_.draft());
  EXPECT_EQ(*second.ops[0].before, Json{"T1-1"});
  EXPECT_EQ(*second.ops[0].after, Json{"T3-2"});
  store["transceivers"]["list"].erase(0);
  store["transceivers"].erase("pinned");
  read(store);
  expect_input_error([&] { planning_.selection(1, "", shop_.json(), shop_.draft()); },
                     "does not have any more");
  expect_input_error([&] { planning_.selection(2, "", shop_.json(), shop_.draft()); }, "not in the list");
}

TEST_F(PlanningOfAShop, NamesLabelsByTheirNumbers) {
  poll();
  const Json found = answer({{"do", "plan_details"}, {"plan", 1U}});
  EXPECT_FALSE(found.at("details").contains("files"));
  EXPECT_FALSE(found.at("details").contains("label_names"));
  EXPECT_EQ(found.at("labels").at("missed"), Json::array());
  std::vector<std::string> names;
  for (const Json& one : found.at("labels").at("undecided")) {
    names.push_back(shop_.draft().scene.labels[one.at(0).get<std::size_t>()].id);
    EXPECT_EQ(names.back(), one.at(1).get<std::string>());
  }
  EXPECT_EQ(names, (std::vector<std::string>{"A1-front-1-2", "A1-front-1-1"}));
  EXPECT_EQ(answer({{"do", "plan_states"}, {"plan", 1U}}).at("shown"), Json::array());
}

TEST_F(PlanningOfAShop, RefusesRequestsThatNoPageSends) {
  expect_input_error([&] { answer({{"do", "plan_details"}, {"plan", 1U}}); }, "not in the list");
  expect_input_error([&] { answer({{"do", "plan_cancel"}, {"plan", 5U}}); }, "not in the list");
  expect_input_error([&] { answer({{"do", "plan_forget"}}); }, "plan");
  expect_input_error([&] { answer({{"do", "plan"}, {"plan", {{"no", 1}}}}); }, "no");
  for (const Json& wrong : {Json(5), Json("x"), Json::array()})
    expect_input_error([&] { answer({{"do", "plan"}, {"plan", wrong}}); }, "plan");
  poll();
  folder_.write("plan/placement.json", "{");
  expect_input_error([&] { answer({{"do", "plan_details"}, {"plan", 1U}}); }, "not valid");
  read(Json::parse(R"({"fixtures": []})"));
  expect_input_error([&] { answer({{"do", "plan"}}); }, "no labels or no candidates");
}

}  // namespace
}  // namespace shelfbeam::serve
