#include "shelfbeam/math/distinct_positions.hpp"
#include "shelfbeam/scene/store/store.hpp"

#include "support/testing.hpp"
#include "unit/scene/same_scene.hpp"
#include "unit/scene/sample_store.hpp"

namespace shelfbeam::test {
namespace {

Store sample() {
  return read(sample_store());
}

TEST(StoreReader, ReadsNameAndRoom) {
  const Store store = sample();
  EXPECT_EQ(store.file, "store.json");
  EXPECT_EQ(store.name, "Sample");
  EXPECT_EQ(store.wavelength_nm, 950);
  ASSERT_TRUE(store.room);
  const Room& room = *store.room;
  EXPECT_TRUE(room.shape.is_box);
  EXPECT_EQ(room.shape.upper(), (Vec3{8, 6, 3}));
  std::string names;
  for (const MaterialId id :
       {room.walls[3], room.walls[1], room.walls[0], room.walls[2], room.floor, room.ceiling})
    names += store.materials[id.value].name + " ";
  EXPECT_EQ(names, "white white white tile tile white ") << "walls x0, x1, y0, y1, floor, ceiling";
}

TEST(StoreReader, ReadsMaterialsInTheirOrder) {
  const Store store = sample();
  ASSERT_EQ(store.materials.size(), 9u);
  EXPECT_EQ(store.materials[1].name, "tile");
  EXPECT_EQ(std::get<Lambertian>(store.materials[1].material).reflectance, 0.5);
}

// The resolved store contains the values that were read, with defaults for omitted values.
TEST(StoreReader, ReadsTypesAndFixtures) {
  using Plain = nlohmann::json;  // the order of keys does not matter
  const Store store = sample();
  const Plain read = Plain::parse(resolved_store_json(store, make_scene(store)));
  Plain given = Plain::parse(sample_store().dump());
  for (Plain& fixture : given["fixtures"]) fixture.erase("labels");
  EXPECT_EQ(read["fixtures"], given["fixtures"]);
  for (Plain& type : given["transceiver_types"]) {
    Plain whole{{"radius", 0}, {"cost", 1}};
    whole.update(type);
    type = whole;
  }
  given["transceiver_types"]["disc"]["emission"]["order"] = 1;
  Plain& fan = given["transceiver_types"]["fan"]["emission"];
  fan["phi_deg"].push_back(360);
  fan["intensity"].push_back(fan["intensity"][0]);
  EXPECT_EQ(read["transceiver_types"], given["transceiver_types"]);
  EXPECT_EQ(read["label_types"]["small"], given["label_types"]["small"]);
  EXPECT_EQ(store.label_types[0].requirement(), 1.5 * 0.02);
  EXPECT_EQ(read["label_types"]["large"],
            Plain::parse(R"({ "responsivity": { "type": "cosine" }, "size": [0, 0], "threshold": 0.01,
                              "safety_factor": 1, "link_cost": 0, "signal_cost": 0 })"));
  EXPECT_EQ(store.fixtures[2].where, "store.json: fixtures[2]");
  const FixtureLabels& labels = std::get<Gondola>(store.fixtures[0].value).labels.value();
  EXPECT_EQ(labels.faces, std::vector{Face::back});
  EXPECT_EQ(labels.spacing, 0.5);
  EXPECT_EQ(labels.tilt_deg, 10);
  EXPECT_EQ(store.label_types[labels.type.value].name, "small");
  const auto& freezer = std::get<Freezer>(store.fixtures[1].value);
  EXPECT_EQ(freezer.labels->faces, (std::vector{Face::left, Face::front}));
}

TEST(StoreReader, KnowsDefaultsOfFixtures) {
  auto json = sample_store();
  for (const char* key : {"rotation_deg", "goods", "stocking", "faces"}) json["fixtures"][0].erase(key);
  for (const char* key : {"faces", "tilt_deg"}) json["fixtures"][0]["labels"].erase(key);
  const Store store = read(json);
  const auto& gondola = std::get<Gondola>(store.fixtures[0].value);
  EXPECT_EQ(gondola.rotation_deg, 0);
  EXPECT_EQ(gondola.goods, gondola.material);
  EXPECT_EQ(gondola.stocking, 0.8);
  EXPECT_EQ(gondola.faces, (std::vector{Face::front, Face::back}));
  EXPECT_EQ(gondola.labels->faces, gondola.faces);
  EXPECT_EQ(gondola.labels->tilt_deg, 0);
  // By default labels are on the sides with boards.
  const Store one = read_text(changed_store("/fixtures/0", R"({ "type": "gondola", "id": "A", "at": [2, 1],
    "length": 3, "depth": 0.9, "height": 1.8, "material": "steel", "shelves": [1], "faces": ["back"],
    "labels": { "type": "small", "spacing": 0.5 } })")
                                  .dump());
  EXPECT_EQ(std::get<Gondola>(one.fixtures[0].value).labels->faces, std::vector{Face::back});
  const Store bare = read_text(changed_store("/wavelength_nm", "").dump());
  EXPECT_EQ(bare.wavelength_nm, 940);
}

TEST(StoreReader, MakesGridsThatIncludeBothEnds) {
  const Scene scene = scene_of(sample_store());
  // 7 - 1 = 6 m by 5 - 1 = 4 m every 2 m: 4 x 3, without the one in the keep-out area, plus two listed.
  ASSERT_EQ(scene.transceivers.size(), 11u + 2);
  EXPECT_EQ(scene.transceivers[0].id, "G1-2-1") << "G1-1-1 at (1, 1) is kept out";
  EXPECT_EQ(scene.transceivers[0].position, (Vec3{3, 1, 2.9}));
  EXPECT_EQ(scene.transceivers[10].id, "G1-4-3");
  EXPECT_EQ(scene.transceivers[10].position, (Vec3{7, 5, 2.9}));
  EXPECT_EQ(scene.type_of(scene.transceivers[10]).name, "down");
  // A spacing that does not divide the extent is adjusted.
  const Scene odd = scene_of(changed_store("/transceivers/grids/0/spacing", "1.7"));
  EXPECT_EQ(odd.transceivers[3].id, "G1-5-1");
  EXPECT_EQ(odd.transceivers[3].position, (Vec3{7, 1, 2.9}));
  EXPECT_EQ(odd.transceivers[0].position.x, 2.5);
  const Scene row = scene_of(changed_store("/transceivers/grids/0/max", "[7, 1]"));
  EXPECT_EQ(row.transceivers.size(), 3u + 2);
}

TEST(StoreReader, ReadsLists) {
  const Scene scene = scene_of(sample_store());
  const Label& label = scene.labels.back();
  EXPECT_EQ(label.id, "L1");
  EXPECT_EQ(label.position, (Vec3{5, 2, 1}));
  EXPECT_EQ(label.normal, (Vec3{0, 0, 1})) << "directions are made unit";
  EXPECT_EQ(scene.type_of(label).name, "large");
  const Transceiver& first = scene.transceivers[11];
  EXPECT_EQ(first.id, "T1");
  EXPECT_LT(length(first.axis - Vec3{0, std::sqrt(0.5), -std::sqrt(0.5)}), 1e-15);
  EXPECT_EQ(first.roll_deg, 30);
  EXPECT_TRUE(first.installed);
  const Transceiver& second = scene.transceivers[12];
  EXPECT_EQ(second.axis, (Vec3{0, 0, -1}));
  EXPECT_EQ(second.roll_deg, 0);
  EXPECT_FALSE(second.installed);
}

TEST(StoreReader, KeepOutsIncludeListedUnits) {
  const auto json = changed_store("/transceivers/keep_out/0", R"({ "min": [0, 3], "max": [1, 3] })");
  const Scene scene = scene_of(json);
  EXPECT_EQ(scene.transceivers.back().id, "T1") << "T2 at (1, 3) is on the border, which belongs to the area";
}

TEST(StoreReader, CandidatesMayShareAMountingPoint) {
  auto json = sample_store();
  auto tilted = json["transceivers"]["grids"][0];
  tilted["axis"] = {0, 1, -1};
  json["transceivers"]["grids"].push_back(tilted);
  json["transceivers"]["installed"] = {"T1", "G2-4-3", "T1"};
  const Scene scene = scene_of(json);
  EXPECT_EQ(scene.transceivers.size(), 2 * 11u + 2);
  EXPECT_EQ(distinct_positions(positions_of(scene.transceivers)).count, 11u + 2);
}

class StoreCsv : public testing::Test {
 protected:
  Scene scene() const {
    auto json = sample_store();
    json["labels"] = {{"csv", "labels.csv"}};
    json["transceivers"]["list"] = {{"csv", "lists/units.csv"}};
    return scene_of(json, folder.path());
  }
  std::string labels = "id,x,y,z,nx,ny,nz,type\nL1,5,2,1,0,0,2,large\n";
  std::string units = "id,x,y,z,ax,ay,az,roll_deg,type\nT1,4,3,2.8,0,1,-1,30,fan\nT2,1,3,2.8,0,0,-1,0,ring\n";
  TempFolder folder;
};

TEST_F(StoreCsv, EqualsTheListInTheStoreFile) {
  folder.write("labels.csv", labels);
  folder.write("lists/units.csv", units);
  const Scene from_csv = scene(), from_list = scene_of(sample_store());
  EXPECT_EQ(fingerprint(from_csv), fingerprint(from_list));
}

// Also beyond the limit of the other numbers of a table, and where squares overflow or vanish.
TEST_F(StoreCsv, TakesDirectionsOfAnyLength) {
  folder.write("lists/units.csv", units);
  const auto normal_of = [&](const std::string& direction) {
    folder.write("labels.csv", "id,x,y,z,nx,ny,nz,type\nL1,5,2,1," + direction + ",large\n");
    return scene().labels.back().normal;
  };
  const Vec3 usual = normal_of("0,-1,1");
  for (const std::string direction : {"0,-1e308,1e308", "0,-1e19,1e19", "0,-1e-170,1e-170"})
    EXPECT_EQ(normal_of(direction), usual) << direction;
  EXPECT_NE(normal_of("0,-1e308,1e307"), usual) << "the control";
}

TEST_F(StoreCsv, IsReadAsSpreadsheetsWriteIt) {
  folder.write("lists/units.csv", "\xEF\xBB\xBF" + units);
  folder.write("labels.csv",
               "id, x, y, z, nx, ny, nz, type, remark\r\n"
               "\"row 3, \"\"left\"\"\" , 5,2,1e0,0,0,2 ,\"large\",any\r\n"
               "\r\n"
               "K\xC3\xBChl, 5,2,-0.0,0,-3,4,small,\r\n");
  const Scene read = scene();
  const auto label = read.labels.end() - 2;
  EXPECT_EQ(label[0].id, "row 3, \"left\"");
  EXPECT_EQ(read.type_of(label[0]).name, "large");
  EXPECT_EQ(label[1].id, "K\xC3\xBChl");
  EXPECT_LT(length(label[1].normal - Vec3{0, -0.6, 0.8}), 1e-15);
}

TEST_F(StoreCsv, IdsThatASpreadsheetHasChangedAreNamed) {
  folder.write("lists/units.csv", units);
  const std::string header = "ID,X,Y,Z,NX,NY,NZ,Type\n", row = ",5,2,1e0,0,0,2,large\n";
  folder.write("labels.csv", header + "1.0" + row + "2.0" + row);
  EXPECT_NE(scene().warnings.front().sentence.find(
                "labels.csv: has ids that look as if a spreadsheet has changed them: "
                "'1.0' in line 2, '2.0' in line 3;"),
            std::string::npos);
}

TEST(StoreReader, WarnsOfPartsOutsideTheRoom) {
  const Scene scene = scene_of(changed_store("/fixtures/2/max", "[8.5, 0.5, 3]"));
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_TRUE(scene.warnings[0].sentence.starts_with("store.json: fixtures[2]: fixture 'C' "));
  EXPECT_TRUE(scene_of(sample_store()).warnings.empty());
}

TEST(StoreReader, LimitsTheNumberOfBoards) {
  auto json = changed_store("/fixtures/0/height", "6");
  json["fixtures"][0]["shelves"].clear();
  for (int k = 1; k <= 51; ++k) json["fixtures"][0]["shelves"].push_back(0.1 * k);
  expect_input_error([&] { scene_of(json); }, "fixtures[0].shelves: ", "51");
}

}  // namespace
}  // namespace shelfbeam::test
