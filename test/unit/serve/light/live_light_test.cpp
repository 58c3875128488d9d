#include "serve/light/live_light.hpp"

#include <sys/wait.h>

#include "jobs/preview/light_frame.hpp"
#include "serve/live/shop.hpp"
#include "unit/plan/plan_store.hpp"
#include "unit/serve/testing.hpp"

namespace shelfbeam::serve {
namespace {

using namespace std::chrono_literals;
using Clock = LiveLight::Clock;

// A shop that is being drawn, and all that pages hear of its light.
class LiveLightOfAShop : public testing::Test {
 protected:
  LiveLightOfAShop() : shop_(folder_.path() / "store.json") { write({"T0-0"}); }

  // Without an id for a unit, none is selected.
  void write(const std::vector<std::string>& selected, double reflectance = 0.6) {
    Json json = Json::parse(PlanStore().text());
    json["materials"]["paper"]["reflectance"] = reflectance;
    json["transceivers"]["selected"] = selected;
    const ShopChanges changes = shop_.update(json.dump(), ++revision_);
    light_.change(json.dump(), revision_, shop_.draft(), changes.changes_light, Clock::now());
    hear(light_.messages(shop_.draft()));
  }
  void hear(const std::vector<http::Message>& messages) {
    for (const http::Message& message : messages)
      heard_.push_back(message.is_text ? Json::parse(*message.bytes) : jobs::about_of(*message.bytes));
  }
  const Json& state() const {
    for (auto message = heard_.rbegin(); message != heard_.rend(); ++message)
      if ((*message)["event"] == "light") return *message;
    throw std::logic_error("no state");
  }
  // `later`: as if that time had passed.
  void look(Clock::duration later = {}) { hear(light_.poll(shop_.draft(), Clock::now() + later)); }
  template <class Is>
  bool wait(const Is& is) {
    return becomes_true([&] { return look(), is(); });
  }
  bool is_done() const { return state()["phase"] == "done"; }
  // The stages of the columns since a message.
  std::vector<std::string> stages(std::size_t from = 0) const {
    std::vector<std::string> list;
    for (std::size_t k = from; k < heard_.size(); ++k)
      if (heard_[k]["event"] == "column") list.push_back(heard_[k]["stage"]);
    return list;
  }

  TempFolder folder_;
  Shop shop_;
  LiveLight light_{folder_.path(), true, SHELFBEAM_BINARY};
  std::uint64_t revision_ = 0;
  std::vector<Json> heard_;
};

TEST_F(LiveLightOfAShop, IsRefinedByItself) {
  EXPECT_EQ(state()["phase"], "waiting");
  EXPECT_EQ(state()["units"][0]["id"], "T0-0");
  EXPECT_THROW(light_.drag({{"id", 1}, {"unit", 0}, {"at", {2, 2}}}, shop_.draft()), InputError);
  ASSERT_TRUE(wait([&] { return is_done() && state()["operator"] == "fine"; }));
  EXPECT_EQ(stages().front(), "direct");
  EXPECT_EQ(stages().back(), "simulated");
  EXPECT_TRUE(state()["undecided"].is_number());
  // A unit that comes is previewed at once, and then simulated; the other one stays as it is.
  const std::size_t from = heard_.size();
  write({"T0-0", "T3-2"});
  EXPECT_EQ(stages(from), (std::vector<std::string>{"fine"}));
  EXPECT_EQ(state()["generation"], 1);
  EXPECT_EQ(state()["phase"], "waiting");
  ASSERT_TRUE(wait([&] { return is_done(); }));
  EXPECT_EQ(stages(from).back(), "simulated");
  // A unit that goes and comes again is known.
  write({"T0-0"});
  const std::size_t again = heard_.size();
  write({"T0-0", "T3-2"});
  EXPECT_TRUE(stages(again).empty());
  // A new page hears everything of the units on the plan.
  std::size_t columns = 0;
  for (const http::Message& message : light_.everything())
    columns += !message.is_text && jobs::about_of(*message.bytes)["event"] == "column" ? 1 : 0;
  EXPECT_EQ(columns, 2U);
}

// Waits until the process of the light has ended or stopped, without a look at its messages.
bool wait_for_process(int change) {
  return becomes_true([=] {
    siginfo_t info{};
    return ::waitid(P_ALL, 0, &info, change | WNOHANG | WNOWAIT) == 0 && info.si_pid != 0;
  });
}

// The process may end between two looks: it has nothing to do after the operator.
TEST_F(LiveLightOfAShop, GoesOnWithUnitsThatComeWhileItPrepares) {
  write({});
  write({}, 0.5);
  look(400ms);  // so that it starts
  write({"T0-0"}, 0.5);
  ASSERT_TRUE(wait_for_process(WEXITED));
  ASSERT_TRUE(wait([&] { return is_done() && !stages().empty() && stages().back() == "simulated"; }))
      << state();
}

// Every unit has a preview soon, however many come at once.
TEST_F(LiveLightOfAShop, PreviewsAllUnitsThatComeAtOnce) {
  ASSERT_TRUE(wait([&] { return is_done(); }));
  std::vector<std::string> ids;
  for (std::size_t k = 0; k < shop_.unit_count() && ids.size() < 10; ++k) ids.push_back(shop_.unit(k)["id"]);
  ASSERT_GT(ids.size(), 5U);
  const std::size_t from = heard_.size();
  write(ids);
  for (int k = 0; k < 3; ++k) look();
  EXPECT_GE(stages(from).size(), ids.size() - 1);
}

// No value of an older generation follows the state of a newer one.
TEST_F(LiveLightOfAShop, DropsValuesOfOlderGenerations) {
  for (int k = 0; k < 4; ++k) {
    const std::size_t from = heard_.size();
    ASSERT_TRUE(wait([&] { return !stages(from).empty(); }));  // others are on their way
    write({"T0-0", "T3-2"}, 0.6 - 0.01 * k);
  }
  ASSERT_TRUE(wait([&] { return is_done(); }));
  std::uint64_t generation = 0;
  for (const Json& message : heard_) {
    if (message["event"] == "light") generation = message["generation"];
    if (message["event"] == "column") {
      EXPECT_EQ(message["generation"], generation);
    }
  }
  EXPECT_EQ(generation, 4U);
}

TEST_F(LiveLightOfAShop, AnswersDrags) {
  ASSERT_TRUE(wait([&] { return state()["operator"] == "fine"; }));
  const http::Message answer = light_.drag({{"id", 5}, {"unit", 0}, {"at", {2.5, 2}}}, shop_.draft());
  const Json about = jobs::about_of(*answer.bytes);
  EXPECT_EQ(about["id"], 5);
  EXPECT_EQ(about["generation"], 1);
  EXPECT_EQ(about["on"], "ceiling");
  EXPECT_NEAR(about["position"][2].get<double>(), 2.98, 1e-9);
  EXPECT_EQ(jobs::column_of(*answer.bytes).signal.size(), shop_.label_count());
  EXPECT_THROW(light_.drag({{"id", 5}, {"unit", 999}, {"at", {2.5, 2}}}, shop_.draft()), InputError);
  const Json mount = LiveLight::mount({{"at", {0.05, 2}}, {"reach", 0.2}, {"type", "wide"}}, shop_.draft());
  EXPECT_EQ(mount["mount"]["on"], "face");
  EXPECT_EQ(mount["mount"]["name"], "wall 3");
}

TEST_F(LiveLightOfAShop, PausesDuringGestures) {
  ASSERT_TRUE(wait([&] { return !stages().empty(); }));
  ASSERT_FALSE(is_done());
  light_.hold(1);
  ASSERT_TRUE(wait_for_process(WSTOPPED | WEXITED));
  look();
  EXPECT_FALSE(is_done());
  light_.release(1, Clock::now());
  EXPECT_TRUE(wait([&] { return is_done(); }));
}

TEST_F(LiveLightOfAShop, SaysWhyThereIsNone) {
  write({});
  ASSERT_TRUE(wait([&] { return state()["operator"] == "fine" && state()["phase"] == "none"; }));
  LiveLight broken(folder_.path(), true, "/bin/false");
  broken.change(PlanStore().text(), 1, shop_.draft(), true, Clock::now() - 1s);
  heard_.clear();
  EXPECT_TRUE(becomes_true([&] {
    hear(broken.poll(shop_.draft(), Clock::now()));
    return !heard_.empty() && state()["phase"] == "failed";
  }));
  EXPECT_EQ(state()["message"], "the light could not be computed");
}

TEST_F(LiveLightOfAShop, IsOffOnRequest) {
  LiveLight off(folder_.path(), false, SHELFBEAM_BINARY);
  off.change(PlanStore().text(), 1, shop_.draft(), true, Clock::now() - 1s);
  heard_.clear();
  hear(off.poll(shop_.draft(), Clock::now()));
  EXPECT_EQ(state()["phase"], "off");
}

TEST_F(LiveLightOfAShop, IsComparedWithTheNewestPlan) {
  EXPECT_TRUE(state()["baseline"].is_null());
  std::filesystem::create_directory(folder_.path() / "plan");
  write_file(folder_.path() / "plan/placement.json",
             R"({"model": "cooperative", "survives_failure": false})");
  write_file(folder_.path() / "plan/signal.h5", "");
  const auto& labels = shop_.draft().scene.labels;
  write_file(folder_.path() / "plan/labels.csv",
             "id,requirement,signal\n" + labels[0].id + ",1,2\n" + labels[2].id + ",2,1\n");
  ASSERT_TRUE(wait([&] { return !state()["baseline"].is_null(); }));
  EXPECT_EQ(state()["baseline"]["plan"], "plan");
  EXPECT_EQ(state()["baseline"]["reached"].get<std::string>().substr(0, 4), "1-0-");
  // The page adds signals up, which plans of other models do not.
  write_file(folder_.path() / "plan/placement.json",
             R"({"model": "non-cooperative", "survives_failure": false})");
  std::filesystem::last_write_time(folder_.path() / "plan/labels.csv",
                                   std::filesystem::file_time_type::clock::now() + 1min);
  EXPECT_TRUE(wait([&] { return state()["baseline"].is_null(); }));
}

}  // namespace
}  // namespace shelfbeam::serve
