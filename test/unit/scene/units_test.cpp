// One shop written in each unit of length.

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "support/expect_input_error.hpp"
#include "support/temp_folder.hpp"
#include "unit/scene/same_scene.hpp"
#include "unit/scene/sample_store.hpp"

namespace shelfbeam {
namespace {

using test::expect_input_error;
using test::Json;
using test::sample_store;
using test::scene_of;
using test::TempFolder;

// The sample store with every length replaced by `change` of it. `at_m` has its unit in its name.
template <class Change>
Json with_lengths(const Change& change) {
  Json store = sample_store();
  const auto all = [&](auto& self, Json& value) -> void {
    if (value.is_array())
      for (Json& element : value) self(self, element);
    else
      value = change(value.get<double>());
  };
  const auto each = [&](Json& object, std::initializer_list<const char*> keys) {
    for (const char* key : keys)
      if (object.contains(key)) all(all, object[key]);
  };
  each(store["room"], {"size"});
  for (Json& material : store["materials"]) each(material, {"thickness"});
  for (Json& type : store["label_types"]) each(type, {"size"});
  for (Json& type : store["transceiver_types"]) each(type, {"radius"});
  for (Json& fixture : store["fixtures"]) {
    each(fixture, {"at", "length", "depth", "height", "shelves", "min", "max"});
    if (fixture.contains("labels")) each(fixture["labels"], {"spacing"});
    if (fixture.contains("parts"))
      for (Json& part : fixture["parts"]) each(part, {"vertices"});
  }
  for (Json& label : store["labels"]) each(label, {"position"});
  for (Json& grid : store["transceivers"]["grids"]) each(grid, {"min", "max", "spacing", "z"});
  for (Json& unit : store["transceivers"]["list"]) each(unit, {"position"});
  for (Json& area : store["transceivers"]["keep_out"]) each(area, {"min", "max"});
  return store;
}

// The double nearest to the decimal number.
double decimal(double value) {
  return std::round(value * 1e7) / 1e7;
}

void expect_same(const Json& store, const Scene& expected) {
  const Scene scene = scene_of(store);
  EXPECT_EQ(test::fingerprint(scene), test::fingerprint(expected)) << store["units"];
  EXPECT_EQ(scene.store_hash, expected.store_hash) << store["units"];
}

TEST(Units, OneShopInEachUnitIsTheSameScene) {
  const Scene expected = scene_of(sample_store());
  for (const auto& [unit, per_metre] : {std::pair("m", 1), std::pair("cm", 100), std::pair("mm", 1000)}) {
    Json store = with_lengths([factor = per_metre](double metres) { return decimal(metres * factor); });
    store["units"] = unit;
    expect_same(store, expected);
  }
  // About three times as large, in quarters of a foot.
  const auto feet = [](double length) { return length < 0.1 ? 4 * length : std::round(12 * length) / 4; };
  const Scene large = scene_of(with_lengths([&](double length) { return decimal(0.3048 * feet(length)); }));
  Json store = with_lengths(feet);
  store["units"] = "ft";
  expect_same(store, large);
  store = with_lengths([&](double length) { return decimal(12 * feet(length)); });
  store["units"] = "in";
  expect_same(store, large);
  // Negative control: a length that is not converted shows.
  store["materials"]["door"]["thickness"] = 0.07;
  EXPECT_NE(scene_of(store).store_hash, large.store_hash);
}

TEST(Units, ResolvedStoresAreInMetres) {
  Json json = with_lengths([](double metres) { return decimal(metres * 1000); });
  json["units"] = "mm";
  const Store store = test::read_text(json.dump());
  const std::string resolved = resolved_store_json(store, make_scene(store));
  EXPECT_EQ(resolved.find("units"), std::string::npos);
  const Store again = test::read_text(resolved);
  EXPECT_EQ(again.unit, LengthUnit::m);
  EXPECT_EQ(resolved_store_json(again, make_scene(again)), resolved);
}

TEST(Units, ErrorsGiveTheValueAsWritten) {
  const auto refuses = [](const std::string& pointer, double value, const std::string& problem) {
    Json json = with_lengths([](double metres) { return decimal(metres * 1000); });
    json["units"] = "mm";
    json[Json::json_pointer(pointer)] = value;
    expect_input_error([&] { scene_of(json); }, "store.json: ", problem);
  };
  refuses("/room/size/0", 2e6, "room.size[0]: is 2000000 mm, which is outside 0.001 to 1000 m");
  refuses("/room/size/0", 0.5, "is 0.5 mm, which is outside 0.001 to 1000 m");
  refuses("/fixtures/2/max/0", 2e7, "is at 20000000 mm; it must be within 10 km of the origin");
  refuses("/transceiver_types/disc/radius", 0.05, "is 0.05 mm, which is outside 0.0001 to 10 m");
  refuses("/label_types/deep/size/0", 10001, "is 10001 mm, which is outside 0.001 to 10 m");
  refuses("/materials/door/thickness", 1001, "is 1001 mm, which is outside 0 to 1 m");
  refuses("/fixtures/0/depth", 99, "is 99 mm, below 0.1 m");
  refuses("/fixtures/1/length", 299, "is 299 mm, below 0.3 m");
  refuses("/fixtures/0/shelves/2", 1800, "is at 1800 mm, not below the height 1800 mm");
  refuses("/fixtures/0/shelves/0", 49, "is 49 mm, below 0.05 m; boards must be at 0.05 m or higher");
  refuses("/label_types/deep/threshold/at_m", 1001, "at_m: is 1001 m, which is outside 0.001 to 1000 m");
  Json json = sample_store();
  json["units"] = "km";
  expect_input_error([&] { scene_of(json); }, "store.json: units: has the unknown value 'km'");
}

class UnitsCsv : public testing::Test {
 protected:
  UnitsCsv() {
    json["units"] = "mm";
    json["labels"] = {{"csv", "labels.csv"}};
  }
  Vec3 label(const std::string& header, const std::string& row) {
    folder.write("labels.csv", header + "\n" + row + "\n");
    const Scene scene = scene_of(json, folder.path());
    for (const Label& one : scene.labels)
      if (one.id == "L1") return one.position;
    return {};
  }
  Vec3 unit(const std::string& header, const std::string& row) {
    folder.write("labels.csv", "id,x,y,z,nx,ny,nz,type\nL1,5000,2000,1000,0,0,1,large\n");
    const Store store = test::read_text(json.dump(), folder.path());
    return make_scene(store_with_units(store, folder.write("units.csv", header + "\n" + row + "\n")))
        .transceivers.at(0)
        .position;
  }
  TempFolder folder;
  Json json = with_lengths([](double metres) { return decimal(metres * 1000); });
};

TEST_F(UnitsCsv, FilesFollowTheStore) {
  const Vec3 expected{5, 2.5, 1};
  EXPECT_EQ(label("id,x,y,z,nx,ny,nz,type", "L1,5000,2500,1000,0,0,1,large"), expected);
  EXPECT_EQ(label("id;x;y;z;nx;ny;nz;type;cost", "L1;5000,0;2500;1000;0;0;1;large;3"), expected);
  EXPECT_EQ(unit("id,x,y,z,ax,ay,az,roll_deg,type", "T,5000,2500,1000,0,0,-1,0,down"), expected);
  expect_input_error([&] { label("id,x,y,z,nx,ny,nz,type", "L1,5000,2500,2e7,0,0,1,large"); }, "line 2",
                     "is at 20000000 mm; it must be within 10 km");
}

// labels.csv and placement.csv of a plan are in metres, regardless of the program that saved them last.
TEST_F(UnitsCsv, FilesOfAPlanAreInMetres) {
  const Vec3 expected{5, 2.5, 1};
  EXPECT_EQ(
      label(
          "id,x,y,z,nx,ny,nz,type,requirement,signal,margin_db,direct_share,serving,strongest,error_trusted",
          "L1,5,2.5,1,0,0,1,large,0.01,0.02,3,0.5,,,"),
      expected);
  EXPECT_EQ(unit("id;x;y;z;ax;ay;az;roll_deg;type;cost;installed;reaches_alone;strongest_for;needed_by",
                 "T;5;2,5;1;0;0;-1;0;down;4;0;1;1;1"),
            expected);
  // Without these columns, the file looks like one in mm; a shop is larger than that.
  expect_input_error(
      [&] { unit("id,x,y,z,ax,ay,az,roll_deg,type", "T,5,2.5,1,0,0,-1,0,down"); },
      "units.csv: ", "all positions within 0.1 m of the origin, because 'units' of the store is 'mm'");
  // Negative control: one position farther away.
  EXPECT_EQ(unit("id,x,y,z,ax,ay,az,roll_deg,type", "T,5,2.5,1,0,0,-1,0,down\nU,5,101,1,0,0,-1,0,down"),
            (Vec3{0.005, 0.0025, 0.001}));
}

}  // namespace
}  // namespace shelfbeam
