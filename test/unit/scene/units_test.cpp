// One shop written in each unit of length.

#include "support/testing.hpp"
#include "unit/scene/same_scene.hpp"
#include "unit/scene/stores.hpp"

namespace shelfbeam::test {
namespace {

void expect_same(const Json& store, const Scene& expected) {
  const Scene scene = scene_of(store);
  EXPECT_EQ(fingerprint(scene), fingerprint(expected)) << store["units"];
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
  const std::string resolved = expect_same_scene(read(sample_in_mm()));
  EXPECT_EQ(resolved.find("units"), std::string::npos);
  EXPECT_EQ(read_text(resolved).unit, LengthUnit::m);
}

class UnitsCsv : public testing::Test {
 protected:
  UnitsCsv() { json["labels"] = {{"csv", "labels.csv"}}; }
  Vec3 label(const std::string& header, const std::string& row) {
    folder.write("labels.csv", header + "\n" + row + "\n");
    return by_id(scene_of(json, folder.path()).labels, "L1").position;
  }
  Vec3 unit(const std::string& header, const std::string& row) {
    folder.write("labels.csv", "id,x,y,z,nx,ny,nz,type\nL1,5000,2000,1000,0,0,1,large\n");
    const Store store = read(json, folder.path());
    return make_scene(store_with_units(store, folder.write("units.csv", header + "\n" + row + "\n")))
        .transceivers.at(0)
        .position;
  }
  TempFolder folder;
  Json json = sample_in_mm();
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
}  // namespace shelfbeam::test
