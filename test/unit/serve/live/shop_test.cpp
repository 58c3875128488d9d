#include "serve/live/shop.hpp"

#include <cstring>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/json_parser.hpp"

#include "unit/serve/live/examples.hpp"

namespace shelfbeam::serve {
namespace {

using Json = nlohmann::ordered_json;
using test::example;
using testing::IsEmpty;

// What a page keeps of the devices, changed by frames as a page does.
class Devices {
 public:
  void take(const std::string& frame) {
    std::uint32_t size = 0;
    std::memcpy(&size, frame.data(), sizeof(size));
    const Json header = Json::parse(frame.substr(4, size));
    const std::size_t from = header["about"]["from"], remove = header["about"]["remove"];
    ASSERT_LE(from + remove, all_.size());
    std::vector<std::string> fresh(header["arrays"][2]["count"].get<std::size_t>());
    std::size_t at = 4 + size;
    for (const Json& array : header["arrays"]) {
      const std::size_t bytes = array["type"] == "u8" ? 1 : 4;
      const std::size_t each =
          bytes * array["count"].get<std::size_t>() / std::max<std::size_t>(1, fresh.size());
      for (std::string& device : fresh) device += frame.substr(at, each), at += each;
    }
    EXPECT_EQ(at, frame.size());
    const auto begin = all_.begin() + static_cast<std::ptrdiff_t>(from);
    all_.insert(all_.erase(begin, begin + static_cast<std::ptrdiff_t>(remove)), fresh.begin(), fresh.end());
  }
  bool operator==(const Devices&) const = default;
  std::size_t size() const { return all_.size(); }

 private:
  std::vector<std::string> all_;
};

// What a page shows.
struct Page {
  std::map<std::string, Json> parts;
  Devices labels, units;

  void take(const ShopChanges& changes) {
    for (const Json& part : changes.parts["set"]) parts[part["key"]] = part;
    for (const Json& key : changes.parts["remove"]) EXPECT_EQ(parts.erase(key), 1U);
    if (changes.labels) labels.take(*changes.labels);
    if (changes.units) units.take(*changes.units);
  }
  bool operator==(const Page&) const = default;
};

Page page_of(const Shop& shop) {
  Page page;
  for (const Json& part : shop.parts()) page.parts[part["key"]] = part;
  if (shop.label_count() > 0) page.labels.take(shop.labels(1));
  if (shop.unit_count() > 0) page.units.take(shop.units(1));
  return page;
}

TEST(Shop, HasThePartsOfTheStore) {
  Shop shop(example("market-hall"));
  const ShopChanges changes = shop.update(read_file(example("market-hall")), 1);
  EXPECT_EQ(changes.parts["set"], shop.parts());
  EXPECT_THAT(changes.parts["remove"], IsEmpty());
  EXPECT_THAT(shop.problems(), IsEmpty());
  std::map<std::string, int> kinds;
  for (const Json& part : shop.parts()) {
    ++kinds[part["kind"]];
    EXPECT_TRUE(shop.json().contains(Json::json_pointer(part["path"]))) << part;
    EXPECT_EQ(part["locked"].is_null(), part["key"].get<std::string>().find('#') == std::string::npos);
    if (part["kind"] != "wall") continue;
    const Json& wall = shop.json()[Json::json_pointer(part["path"])];
    EXPECT_EQ(part.value("holes", Json::array()).size(), wall.value("openings", Json::array()).size())
        << part;
  }
  EXPECT_EQ(kinds["room"], 1);
  for (const char* kind : {"fixture", "zone", "wall"}) EXPECT_GT(kinds[kind], 0) << kind;
  EXPECT_EQ(shop.label_count(), 343U);
  EXPECT_EQ(shop.unit_count(), 94U);
}

// A page that applies every change shows the same as a page that is opened at the end.
TEST(Shop, ChangesAddUp) {
  Json store = parse_json(read_file(example("grocery")), "store.json");
  Shop shop(example("grocery"));
  Page page;
  page.take(shop.update(store.dump(), 1));
  std::mt19937 random(51);
  const auto number = [&](std::size_t below) {
    return std::uniform_int_distribution<std::size_t>(0, below - 1)(random);
  };
  Json& fixtures = store["fixtures"];
  const Json original = fixtures;
  std::size_t differences = 0;
  for (std::uint64_t revision = 2; revision < 60; ++revision) {
    const std::size_t k = number(fixtures.size());
    switch (number(5)) {
      case 0:
        if (fixtures[k].contains("at")) fixtures[k]["at"][0] = 0.01 * static_cast<double>(number(1000));
        break;
      case 1:
        fixtures.erase(k);
        break;
      case 2:
        fixtures.insert(fixtures.begin() + static_cast<std::ptrdiff_t>(k), original[number(original.size())]);
        break;
      case 3:
        fixtures[k]["material"] = "no such material";
        break;
      default:
        fixtures = original;
    }
    page.take(shop.update(store.dump(), revision));
    const Page fresh = page_of(shop);
    ASSERT_EQ(page.parts, fresh.parts);
    ASSERT_TRUE(page == fresh) << revision;
    // Elements with problems keep their last outlines; all other parts are those of the text alone.
    Shop other(example("grocery"));
    other.update(store.dump(), revision);
    for (const Json& part : other.parts())
      if (!part.contains("unfinished")) {
        ASSERT_EQ(page.parts[part["key"]], part);
      }
    differences += other.problems().empty() ? 0 : 1;
  }
  EXPECT_GT(differences, 10U) << "half-drawn shops are among them";
}

// The part of an element, or null.
Json part_at(const Shop& shop, const std::string& key) {
  for (const Json& part : shop.parts())
    if (part["key"] == key) return part;
  return {};
}

TEST(Shop, KeepsTheLastOutlineOfAnElementWithProblems) {
  Json store = parse_json(read_file(example("grocery")), "store.json");
  Shop shop(example("grocery"));
  shop.update(store.dump(), 1);
  const Json before = part_at(shop, "fixtures/8");
  ASSERT_EQ(before["id"], "F1");
  ASSERT_FALSE(before.contains("unfinished"));
  store["fixtures"][8]["length"] = -3;
  shop.update(store.dump(), 2);
  EXPECT_EQ(shop.problems()[0]["pointer"], "/fixtures/8/length");
  Json kept = before;
  kept["unfinished"] = true;
  EXPECT_EQ(part_at(shop, "fixtures/8"), kept);
  // It follows its place, and is kept over further edits.
  store["fixtures"][8]["at"][0] = store["fixtures"][8]["at"][0].get<double>() + 2;
  shop.update(store.dump(), 3);
  const Json moved = part_at(shop, "fixtures/8");
  EXPECT_NEAR(moved["outline"][0][0].get<double>(), before["outline"][0][0].get<double>() + 2, 1e-9);
  EXPECT_NEAR(moved["footing"]["at"][0].get<double>(), before["footing"]["at"][0].get<double>() + 2, 1e-9);
  EXPECT_EQ(moved["outline"][0][1], before["outline"][0][1]);
  store["fixtures"].erase(8);
  shop.update(store.dump(), 4);
  EXPECT_THAT(shop.problems(), IsEmpty());
  EXPECT_NE(part_at(shop, "fixtures/8")["id"], "F1");
}

TEST(Shop, ShowsAFixtureThatNeverHadAnOutline) {
  Json store = parse_json(read_file(example("grocery")), "store.json");
  store["fixtures"][8]["length"] = -3;
  store["fixtures"].push_back({{"type", "box"}, {"id", "new"}});
  store["fixtures"].push_back(7);
  const std::size_t last = store["fixtures"].size() - 1;
  Shop shop(example("grocery"));
  shop.update(store.dump(), 1);
  const Json square = part_at(shop, "fixtures/8");
  EXPECT_EQ(square["outline"], Json::parse("[[6, 14.2], [7, 14.2], [7, 15.2], [6, 15.2]]"));
  EXPECT_EQ(square["unfinished"], true);
  EXPECT_EQ(part_at(shop, "fixtures/" + std::to_string(last - 1))["outline"][0], Json::parse("[12.5, 9.0]"));
  EXPECT_EQ(part_at(shop, "fixtures/" + std::to_string(last))["id"], "");
}

TEST(Shop, ShowsFixturesOfTheSameId) {
  Json store = parse_json(read_file(example("grocery")), "store.json");
  store["fixtures"][1]["id"] = "A1";
  Shop shop(example("grocery"));
  shop.update(store.dump(), 1);
  ASSERT_FALSE(shop.problems().empty());
  EXPECT_EQ(part_at(shop, "fixtures/1")["outline"][0], Json::parse("[5.0, 7.0]"));
}

TEST(Shop, KnowsTheCopyWithAProblem) {
  Json store = parse_json(read_file(example("grocery")), "store.json");
  store["fixtures"][0]["id"] = "A2-west";
  Shop shop(example("grocery"));
  shop.update(store.dump(), 1);
  ASSERT_EQ(part_at(shop, "fixtures/4#2")["id"], "A2-west");
  ASSERT_FALSE(shop.problems().empty());
  EXPECT_EQ(shop.problems()[0]["pointer"], "/fixtures/4");
  EXPECT_EQ(shop.problems()[0]["key"], "fixtures/4#2");
  Json other{{"path", "fixtures[4] (copy 'A3-west')"}}, whole{{"path", "fixtures[4].repeat"}};
  shop.locate(other);
  EXPECT_EQ(other["key"], "fixtures/4#3");
  shop.locate(whole);
  EXPECT_FALSE(whole.contains("key"));
}

TEST(Shop, DescribesDevicesAndFixtures) {
  Shop shop(example("grocery"));
  shop.update(read_file(example("grocery")), 1);
  const Json label = shop.label(0), unit = shop.unit(0);
  EXPECT_TRUE(label["path"].get<std::string>().starts_with("/fixtures/")) << label;
  EXPECT_TRUE(unit["path"].get<std::string>().starts_with("/transceivers/")) << unit;
  const Json hits = shop.find(label["id"]);
  ASSERT_FALSE(hits.empty());
  EXPECT_EQ(hits[0]["kind"], "label");
  EXPECT_EQ(hits[0]["index"], 0);
  EXPECT_LE(shop.find("").size(), 50U);
  const Json details = shop.details("/fixtures/0");
  EXPECT_EQ(details["effective"]["type"], details["resolved"]["type"]);
  EXPECT_EQ(details["inherited"]["length"], details["effective"]["length"]);
  EXPECT_FALSE(details["inherited"].contains("id"));
  const Json presets = shop.presets();
  EXPECT_EQ(presets["end"]["effective"]["type"], "gondola") << "a key of its own preset";
  EXPECT_EQ(presets["end"]["effective"]["length"], 0.9);
  EXPECT_TRUE(presets["end"]["units"].empty());
  shop.update(R"({"fixtures": [{"preset": "none", "id": "a"}]})", 2);
  EXPECT_THROW(shop.details("/fixtures/0"), InputError) << "of a store without presets";
  for (const char* wrong : {"/fixtures/999", "/fixtures/x", "/fixtures/", "/room", ""})
    EXPECT_THROW(shop.details(wrong), InputError) << wrong;
}

TEST(Shop, ReadsNoFileOutsideItsFolder) {
  Json store = parse_json(read_file(example("grocery")), "store.json");
  store["labels"] = {{"csv", "../thesis/store.json"}};
  Shop shop(example("grocery"));
  shop.update(store.dump(), 1);
  ASSERT_EQ(shop.problems().size(), 1U);
  EXPECT_THAT(shop.problems()[0]["sentence"],
              testing::EndsWith("is outside the folder of the store file; move it there"));
}

TEST(Shop, HasTheSurfacesForTheView) {
  Shop shop(example("grocery"));
  shop.update(read_file(example("grocery")), 1);
  const std::string frame = shop.scene(1);
  EXPECT_NE(frame.find("\"mesh_triangle\""), std::string::npos);
  EXPECT_GT(frame.size(), 90'000U);
}

}  // namespace
}  // namespace shelfbeam::serve
