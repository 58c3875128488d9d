#include "shelfbeam/scene/states/store_states.hpp"

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/base/error.hpp"
#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/stats/moments.hpp"

#include "support/processor_time.hpp"
#include "support/testing.hpp"
#include "unit/scene/same_scene.hpp"
#include "unit/scene/stores.hpp"

namespace shelfbeam::test {
namespace {

struct Shop {
  explicit Shop(const Json& json = changing_shop(), std::uint64_t seed = 1)
      : store(read(json)), scene(make_scene(store)), states(store, scene, seed) {}

  Store store;
  Scene scene;
  StoreStates states;
};

std::string text_of(const Store& state) {
  return resolved_store_json(state, make_scene(state));
}

const Shelving& shelves(const Store& state, std::size_t fixture) {
  return *shelving_of(state.fixtures[fixture].value);
}

TEST(StoreStates, DependOnSeedAndNumberOnly) {
  const Shop one, two, other(changing_shop(), 2);
  const std::string third = text_of(one.states.state(3));
  EXPECT_EQ(text_of(two.states.state(3)), third);
  EXPECT_NE(text_of(one.states.state(4)), third);
  EXPECT_NE(text_of(other.states.state(3)), third);
}

TEST(StoreStates, AreOrdinaryStores) {
  const Shop one;
  for (int k = 0; k < 20; ++k) {
    const std::string text = expect_same_scene(one.states.state(k));
    EXPECT_FALSE(read_text(text).variation);
  }
}

TEST(StoreStates, KeepLabelsAndCandidatesInTheirOrder) {
  const Shop one;
  const Scene scene = make_scene(one.states.state(5));
  ASSERT_EQ(scene.labels.size(), one.scene.labels.size());
  ASSERT_EQ(scene.transceivers.size(), one.scene.transceivers.size());
  for (std::size_t i = 0; i < scene.labels.size(); ++i) {
    EXPECT_EQ(scene.labels[i].id, one.scene.labels[i].id);
    EXPECT_EQ(scene.labels[i].position, one.scene.labels[i].position);
  }
  std::size_t installed = 0;
  for (std::size_t j = 0; j < scene.transceivers.size(); ++j) {
    EXPECT_EQ(scene.transceivers[j].id, one.scene.transceivers[j].id);
    installed += scene.transceivers[j].installed ? 1 : 0;
  }
  EXPECT_EQ(installed, 1U);
}

// z-tests of 2000 states at 5 standard errors each: a correct program fails with a probability of 1e-5.
TEST(StoreStates, HaveTheGivenDistributions) {
  const Shop one;
  constexpr int states = 2000;
  Moments stock, squared_stock, product, people, squared_people, open, pallets, power, position, tilt;
  for (int k = 0; k < states; ++k) {
    const Store state = one.states.state(static_cast<std::uint64_t>(k));
    const auto& rows = shelves(state, 0).row_stocking;
    ASSERT_EQ(rows.at(Face::front).size(), 4U);
    const double a = (rows.at(Face::front)[0] - 0.65) / 0.25, b = (rows.at(Face::back)[2] - 0.65) / 0.25;
    stock.add(a);
    squared_stock.add(a * a);
    product.add(a * b);
    EXPECT_EQ(shelves(state, 1).stocking, 0.7);
    open.add(shelves(state, 1).doors_open ? 1 : 0);
    double persons = 0, has_pallet = 0;
    for (const auto& [fixture, where] : state.fixtures) {
      persons += id_of(fixture).starts_with("person") ? 1 : 0;
      has_pallet += id_of(fixture) == "pallet" ? 1 : 0;
    }
    people.add(persons);
    squared_people.add((persons - 4) * (persons - 4));
    pallets.add(has_pallet);
    const Transceiver &unit = state.transceivers[20].value, &planned = one.scene.transceivers[20];
    power.add(10 * std::log10(unit.relative_power) / 0.5);
    position.add((unit.position.x - planned.position.x) / 0.05);
    tilt.add(std::acos(std::min(1.0, dot(unit.axis, planned.axis))) * 180 / pi);
  }
  const auto expect = [](const Moments& found, double mean, double deviation, const char* what) {
    EXPECT_NEAR(found.mean(), mean, 5 * deviation / std::sqrt(states)) << what;
  };
  expect(stock, 0, std::sqrt(1 / 3.0), "stocking");
  expect(squared_stock, 1 / 3.0, std::sqrt(1 / 5.0 - 1 / 9.0), "its square");
  // Uniform variables with a Gaussian copula: Spearman's rho is 6 / pi asin(r / 2).
  expect(product, 2 / pi * std::asin(0.3), 0.45, "correlation");
  expect(people, 4, 2, "people");
  expect(squared_people, 4, std::sqrt(4 + 2 * 16.0), "their variance");
  expect(open, 0.25, std::sqrt(0.25 * 0.75), "doors");
  expect(pallets, 0.3, std::sqrt(0.3 * 0.7), "pallets");
  expect(power, 0, 1, "power");
  expect(position, 0, 1, "position");
  expect(tilt, 2 * std::sqrt(pi / 2), 2 * std::sqrt(2 - pi / 2), "tilt");
  // The control: one of independent rows.
  EXPECT_GT(std::abs(product.mean()), 5 / 3.0 / std::sqrt(states));
}

TEST(StoreStates, StandPeopleAndObjectsOnFreeFloor) {
  Json crowded = changing_shop();
  crowded["variation"]["people"][0]["number"] = 60;
  const Shop one(crowded);
  for (std::uint64_t k = 0; k < 20; ++k) {
    const Store state = one.states.state(k);
    const Scene scene = make_scene(state);
    std::vector<const Part*> boxes, others;
    for (const Part& part : scene.parts) {
      const std::string& id = scene.fixtures[part.fixture].id;
      (id.starts_with("person") || id == "pallet" ? boxes : others).push_back(&part);
    }
    EXPECT_GT(boxes.size(), 55U);
    for (std::size_t b = 0; b < boxes.size(); ++b) {
      for (const Vec2& corner : boxes[b]->footprint) {
        EXPECT_TRUE(scene.room->covers(corner));
        EXPECT_GE(scene.room->ceiling_over(corner).at(corner), boxes[b]->top) << "not below the low ceiling";
      }
      for (std::size_t c = 0; c < b; ++c) EXPECT_FALSE(overlap(boxes[b]->footprint, boxes[c]->footprint));
      for (const Part* part : others)
        EXPECT_FALSE(part->bottom < boxes[b]->top && part->kind != PartKind::mesh &&
                     overlap(boxes[b]->footprint, part->footprint));
    }
    EXPECT_EQ(sentences(scene.warnings), std::vector<std::string>());
  }
}

// Boxes that fit nowhere, or not all at once, cost as many draws as any others.
TEST(StoreStates, OmitPeopleWithoutAPlace) {
  Json full = changing_shop();
  const auto people_of = [&](const char* area, double length, double width) {
    full["variation"]["people"][0]["number"] = 100;
    full["variation"]["people"][0]["size"] = {length, width, 1.75};
    full["variation"]["people"][0]["area"] = Json::parse(area);
    const Shop one(full);
    const Store state = one.states.state(0);
    return std::count_if(state.fixtures.begin(), state.fixtures.end(),
                         [](const auto& fixture) { return id_of(fixture.value).starts_with("person"); });
  };
  const ProcessorTime time;
  EXPECT_EQ(people_of(R"("room")", 14, 13), 0) << "wider than the room between its walls";
  EXPECT_EQ(people_of(R"("room")", 40, 30), 0) << "larger than the room";
  EXPECT_EQ(people_of(R"("low")", 0.5, 0.3), 0) << "below a ceiling of 1.7 m";
  EXPECT_EQ(people_of("[[8.1, 8.1], [8.9, 8.1], [8.9, 8.9], [8.1, 8.9]]", 0.5, 0.3), 0) << "in a hole";
  const auto many = people_of(R"("room")", 0.5, 0.3);
  EXPECT_GT(many, 60);
  EXPECT_LT(time.seconds(), 20);  // 0.5 s; 60 s when each draw divided the plan
}

// Whether people stand in a zone in front of the first wall.
bool stand_in_zone(const char* area) {
  Json divided = changing_shop();
  divided["room"]["zones"] = R"([{"id": "door", "polygon": [[0, 0], [7, 0], [7, 1.5], [0, 1.5]],
    "height": 2.9}])"_json;
  divided["variation"]["people"][0]["number"] = 60;
  divided["variation"]["people"][0]["area"] = area;
  const Shop one(divided);
  const Store state = one.states.state(0);
  std::size_t people = 0, in_zone = 0;
  for (const auto& [fixture, where] : state.fixtures)
    if (const auto footing = footing_of(fixture); footing && id_of(fixture).starts_with("person")) {
      ++people;
      if (footing->at[0] < 6.5 && footing->at[1] < 1) ++in_zone;
    }
  EXPECT_GT(people, 30u);
  return in_zone > 0;
}

TEST(StoreStates, KeepPeopleOutOfZonesInTheRoomWithoutThem) {
  EXPECT_FALSE(stand_in_zone("room without zones"));
  EXPECT_TRUE(stand_in_zone("room")) << "negative control";
}

// Objects behind people who do not fit still have a place.
TEST(StoreStates, OverfullAreasTakeLimitedTime) {
  Json full = changing_shop();
  full["variation"]["people"] = Json::array();
  for (int k = 0; k < 4; ++k)
    full["variation"]["people"].push_back({{"id", "group" + std::to_string(k)},
                                           {"number", 1000},
                                           {"size", {0.5, 0.3, 1.75}},
                                           {"area", "low"},
                                           {"material", full["variation"]["objects"][0]["material"]}});
  full["variation"]["objects"][0]["present"] = 1;
  const Shop one(full);
  const std::string object = full["variation"]["objects"][0]["id"];
  const ProcessorTime time;
  const Store state = one.states.state(0);
  EXPECT_LT(time.seconds(), 20);
  EXPECT_TRUE(std::any_of(state.fixtures.begin(), state.fixtures.end(),
                          [&](const auto& fixture) { return id_of(fixture.value) == object; }));
}

TEST(StoreStates, AndScenesAndChecksCanBeCancelled) {
  CancelToken token;
  const std::string text = changing_shop().dump();
  const Store store = parse_store(text, "store.json", {}, {.cancel = &token});
  const Scene scene = make_scene(store);
  const StoreStates states(store, scene, 1);
  EXPECT_NO_THROW(make_scene(states.state(1)));
  token.request();
  EXPECT_THROW(parse_store(text, "store.json", {}, {.cancel = &token}), Interrupted);
  EXPECT_THROW(make_scene(store), Interrupted);
  EXPECT_THROW(states.state(1), Interrupted);
  EXPECT_THROW(resolved_store_json(store, scene), Interrupted);
}

TEST(StoreStates, OptionsOfAMountingPointMoveTogether) {
  const Shop one;
  const Scene scene = make_scene(one.states.state(0));
  std::map<std::string, Vec3> first;
  std::size_t pairs = 0;
  for (const Transceiver& unit : scene.transceivers) {
    const std::string mount = unit.id.substr(0, unit.id.find('/'));
    const auto [found, is_new] = first.emplace(mount, unit.position);
    if (is_new) continue;
    EXPECT_EQ(found->second, unit.position) << mount;
    ++pairs;
  }
  EXPECT_GT(pairs, 10U);
}

// What a cause draws in a state, as text. The place of an object depends on the people who stand there first.
std::string drawn(const Store& state, Cause cause) {
  std::string text;
  for (const auto& [fixture, where] : state.fixtures) {
    const Shelving* shelving = shelving_of(fixture);
    if (cause == Cause::stock && shelving != nullptr)
      text += fmt::format("{} {};", shelving->stocking, shelving->arrangement);
    if (cause == Cause::doors && shelving != nullptr) text += shelving->doors_open ? "open;" : "shut;";
    const auto* box = std::get_if<Box>(&fixture);
    const bool is_person = box != nullptr && box->id.starts_with("person"),
               is_object = box != nullptr && box->id.starts_with("pallet");
    if (cause == Cause::people && is_person)
      text += fmt::format("{} {} {} {};", box->id, box->min.x, box->min.y, box->rotation_deg);
    if (cause == Cause::objects && is_object) text += box->id;
  }
  if (cause == Cause::mounting)
    for (const auto& [unit, where] : state.transceivers)
      text += fmt::format("{} {} {} {};", unit.position.x, unit.position.y, unit.axis.x, unit.relative_power);
  if (cause == Cause::labels)
    for (const auto& [label, where] : state.labels) text += fmt::format("{};", label.relative_sensitivity);
  return text;
}

TEST(StoreStates, LeaveCausesOutWithoutChangingOthers) {
  const Shop whole;
  const std::vector<Cause> causes = whole.states.causes();
  ASSERT_EQ(causes.size(), cause_keys.size() - 1);
  for (const Cause without : causes) {
    Json json = changing_shop();
    json["variation"]["without"] = {key_of(without)};
    const Shop part(json);
    std::vector<Cause> others = causes;
    std::erase(others, without);
    EXPECT_EQ(part.states.causes(), others);
    bool differs = false;
    for (std::uint64_t k = 0; k < 20; ++k) {
      const Store state = part.states.state(k), full = whole.states.state(k),
                  fixed = whole.states.state(StateNumbers::only({}, k), whole.scene);
      EXPECT_EQ(state.name, full.name);
      for (const Cause cause : others) EXPECT_EQ(drawn(state, cause), drawn(full, cause)) << k;
      EXPECT_EQ(drawn(state, without), drawn(fixed, without)) << k;
      differs = differs || drawn(full, without) != drawn(fixed, without);
    }
    EXPECT_TRUE(differs) << key_of(without);
  }
}

TEST(StoreStates, LeaveOutOnlyChangesOfAVariation) {
  Json json = changing_shop();
  Store store = read(json);
  leave_out(store, {Cause::doors, Cause::stock, Cause::doors});
  EXPECT_EQ(store.variation->without, (std::vector{Cause::stock, Cause::doors}));
  EXPECT_NE(make_scene(store).store_hash, Shop().scene.store_hash);
  json.erase("variation");
  Store fixed = read(json);
  leave_out(fixed, {});
  expect_input_error([&] { leave_out(fixed, {Cause::people}); }, "has no section 'variation'");
  expect_input_error([&] { Shop{json}; }, "has no section 'variation'");
}

TEST(StoreStates, VariationIsReadBackToTheBit) {
  EXPECT_THAT(expect_same_scene(Shop().store), testing::HasSubstr("\"variation\""));
}

TEST(Variation, LimitsPeopleAndPatterns) {
  Json store = changing_shop();
  Json& people = store["variation"]["people"];
  for (int k = 1; k < 6; ++k) {
    people.push_back(people[0]);
    people.back()["id"] = std::to_string(k);
    people.back()["number"] = {{"uniform", {0, 1000}}};
  }
  expect_input_error([&] { read(store); },
                     "variation.people[5].number: makes 5004 people and objects, together "
                     "with those before; at most 5000 are allowed");
  store = changing_shop();
  store["fixtures"][1]["id"] = "chill" + std::string(100'000, 'a');
  const std::string pattern = "chill*" + std::string(500, 'a') + "*" + std::string(600, 'a') + "b*";
  store["variation"]["doors"][0]["fixtures"] = pattern;
  const ProcessorTime time;
  expect_input_error([&] { read(store); },
                     "variation.doors: has patterns with 1,110 characters for the 100,006 "
                     "characters of the ids of fixtures");
  EXPECT_LT(time.seconds(), 2);
}

}  // namespace
}  // namespace shelfbeam::test
