#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/scene/light_keys.hpp"

#include "support/testing.hpp"
#include "unit/scene/same_scene.hpp"
#include "unit/scene/sample_store.hpp"

namespace shelfbeam::test {
namespace {

TEST(ResolvedStore, OfTheExamplesIsTheSameScene) {
  for (const char* name : {"thesis", "grocery", "chiller", "supermarket"})
    expect_same_scene(
        read_store(std::filesystem::path(SHELFBEAM_SOURCE_DIR) / "examples" / name / "store.json"));
}

TEST(ResolvedStore, OfTheSampleIsTheSameScene) {
  Json store = sample_store();
  expect_same_scene(read(store));
  store["fixtures"][0]["doors"] = "snow";
  store["fixtures"][1]["doors"] = "tile";
  expect_same_scene(read(store));
}

TEST(ResolvedStore, WithListsInFilesIsTheSameScene) {
  const TempFolder folder;
  folder.write("labels.csv",
               "id,x,y,z,nx,ny,nz,type\nL1,5.1,2.3,0.1,0.3,-7,0.123456789,large\n\"a, "
               "\"\"b\"\"\",1,2,1,1,1,1,small\n");
  folder.write("units.csv", "id,x,y,z,ax,ay,az,roll_deg,type\nT1,4.7,3,2.8,0.1,1,-1,30,fan\n");
  folder.write("roof.obj", "v 0 0 0\nv 1.1 0 0\nv 0 0.7 0.3\nf 1 2 3\n");
  Json store = sample_store();
  store["labels"] = {{"csv", "labels.csv"}};
  store["transceivers"]["list"] = {{"csv", "units.csv"}};
  store["fixtures"][3] = R"({ "type": "mesh", "id": "M", "file": "roof.obj", "at": [6.1, 4, 0.5],
    "rotation_deg": 12.3, "scale": 0.37, "materials": { "*": "steel" } })"_json;
  expect_same_scene(read(store, folder.path()));
}

TEST(ResolvedStore, KeepsOddAngles) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> turn(-360, 360);
  for (int k = 0; k < 100; ++k) {
    Json store = sample_store();
    for (const std::size_t fixture : {0, 1, 3}) store["fixtures"][fixture]["rotation_deg"] = turn(random);
    store["fixtures"][0]["at"] = {2 + turn(random) / 1e3, 1};
    store["fixtures"][0]["labels"]["tilt_deg"] = turn(random) / 5;
    store["transceivers"]["grids"][0]["axis"] = {turn(random), turn(random), turn(random)};
    store["transceivers"]["list"][0]["roll_deg"] = turn(random);
    store["labels"][0]["normal"] = {turn(random), turn(random), turn(random)};
    store.erase("room");
    expect_same_scene(read(store));
  }
}

TEST(ResolvedStore, KeepsTheAnglesOfTables) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> step(0.001, 1.8);
  for (int k = 0; k < 30; ++k) {
    const int thetas = k % 2 == 0 ? 100 : 8, phis = k % 2 == 0 ? 8 : 100;
    Json theta{0}, phi{0}, rows = Json::array();
    for (int t = 1; t < thetas; ++t) theta.push_back(theta.back().get<double>() + step(random));
    for (int p = 1; p < phis; ++p) phi.push_back(phi.back().get<double>() + 2 * step(random));
    for (int p = 0; p < phis; ++p) {
      rows.push_back(Json::array());
      for (int t = 0; t < thetas; ++t) rows.back().push_back(step(random));
    }
    Json store = sample_store();
    store["transceiver_types"]["fan"]["emission"] = {
        {"type", "table"}, {"theta_deg", theta}, {"phi_deg", phi}, {"intensity", rows}};
    expect_same_scene(read(store));
  }
}

// All notations of materials, and all photometric files: all symmetries, types C and B.
TEST(ResolvedStore, KeepsMaterials) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0.01, 1);
  const auto roughness = [&](bool anisotropic) {
    return anisotropic ? Json{share(random), share(random)} : Json(share(random));
  };
  Json store = sample_store();
  Json& materials = store["materials"];
  int count = 0;
  const auto add = [&](Json material) { materials["m" + std::to_string(count++)] = std::move(material); };
  for (const bool anisotropic : {false, true})
    for (const auto& [distribution, masking, sampling] : {std::array{"ggx", "smith", "visible"},
                                                          {"ggx", "smith", "all"},
                                                          {"ggx", "cook_torrance", "visible"},
                                                          {"beckmann", "smith", "all"},
                                                          {"beckmann", "smith_rational", "all"},
                                                          {"beckmann", "cook_torrance", "all"}}) {
      const Json facets{{"roughness", roughness(anisotropic)},
                        {"distribution", distribution},
                        {"masking", masking},
                        {"sampling", sampling}};
      const auto with_facets = [&](Json material) {
        material.update(facets);
        add(material);
      };
      with_facets({{"type", "conductor"}, {"eta", share(random)}, {"k", 10 * share(random)}});
      if (!anisotropic)
        with_facets({{"type", "plastic"}, {"ior", 1 + share(random)}, {"reflectance", share(random)}});
      if (std::string(masking) != "cook_torrance")
        with_facets({{"type", "dielectric"}, {"ior", 1.01 + share(random)}});
    }
  add({{"type", "dielectric"}, {"ior", 1 + share(random)}});
  add({{"type", "lambertian"}, {"reflectance", "plaster"}});
  add({{"type", "plastic"}, {"ior", 1.5}, {"reflectance", "ceramic_tile"}});
  add({{"type", "thin_dielectric"}, {"ior", 1 + share(random)}, {"thickness", share(random)}});
  const Json resolved = Json::parse(expect_same_scene(read(store)));
  EXPECT_EQ(resolved["materials"]["m" + std::to_string(count - 3)],
            R"({ "type": "lambertian", "reflectance": 0.836 })"_json);
}

TEST(ResolvedStore, KeepsProfilesOfFiles) {
  for (const char* folder : {"/data/photometry", "/test/data/photometry"})
    for (const auto& entry :
         std::filesystem::directory_iterator(SHELFBEAM_SOURCE_DIR + std::string(folder))) {
      const auto name = entry.path().filename().string();
      if (name.ends_with(".md")) continue;
      SCOPED_TRACE(name);
      Json store = sample_store();
      store["transceiver_types"]["ring"]["emission"] = {
          {"type", name.ends_with(".ies") ? "ies" : "eulumdat"}, {"file", name}, {"flux", 0.7}};
      store["label_types"]["deep"]["threshold"] = {{"hears", "ring"}, {"at_m", 3.3}, {"angle_deg", 45}};
      if (name == "upwards.ies") store["label_types"]["deep"]["threshold"]["angle_deg"] = 135;
      expect_same_scene(read(store, entry.path().parent_path()));
    }
}

TEST(ResolvedStore, HasEverythingListed) {
  const Store store = read(sample_store());
  const Scene scene = make_scene(store);
  const Json resolved = Json::parse(resolved_store_json(store, scene));
  EXPECT_EQ(resolved["labels"].size(), scene.labels.size());
  EXPECT_EQ(resolved["transceivers"]["list"].size(), scene.transceivers.size());
  EXPECT_EQ(resolved["transceivers"]["installed"], R"(["T1"])"_json);
  EXPECT_EQ(resolved["label_types"]["deep"]["threshold"], 0.08) << "not as a range";
  for (const char* key : {"grids", "keep_out"}) EXPECT_FALSE(resolved["transceivers"].contains(key));
  for (const Json& fixture : resolved["fixtures"]) {
    EXPECT_FALSE(fixture.contains("labels"));
    EXPECT_FALSE(fixture.contains("file"));
  }
}

std::string hash_without_store(Scene scene) {
  scene.store_hash.clear();
  return scene_hash(scene);
}

// The smallest change of any number or text of a scene must change both the comparison of the tests above and
// the hash of its content.
TEST(ResolvedStore, ComparisonAndHashDetectEveryChange) {
  const Scene scene = scene_of(sample_store());
  const std::string before = fingerprint(scene), hash_before = hash_without_store(scene);
  std::vector<std::pair<std::string, std::string>> changes = {
      {"/room/walls/x0", "\"tile\""},         {"/materials/chrome/masking", "\"smith\""},
      {"/materials/jar/sampling", "\"all\""}, {"/materials/jar/distribution", "\"beckmann\""},
      {"/materials/carton/roughness", "0.5"}, {"/fixtures/0/goods", "\"steel\""},
      {"/fixtures/1/doors", "\"tile\""},      {"/fixtures/0/id", "\"B\""},
      {"/transceivers/installed", "[]"},
  };
  // Bounds, normalised directions, numbers of vertices, and the angle of the largest intensity may hide a
  // change.
  const auto may_hide = [](const std::string& pointer) {
    for (const char* part :
         {"/keep_out/", "/spacing", "/normal/", "/grids/0/axis/", "/parts/0/faces/", "/angle_deg"})
      if (pointer.find(part) != std::string::npos) return true;
    return false;
  };
  const Json values = sample_store().flatten();
  for (const auto& [pointer, value] : values.items())
    if (value.is_number() && value != 0 && !may_hide(pointer))
      changes.emplace_back(pointer, Json(value.get<double>() * (1 - 1e-12)).dump());
  EXPECT_GT(changes.size(), 100u);
  for (const auto& [pointer, value] : changes) {
    const Scene changed = scene_of(changed_store(pointer, value));
    EXPECT_NE(fingerprint(changed), before) << pointer;
    EXPECT_NE(hash_without_store(changed), hash_before) << pointer;
  }
}

TEST(ResolvedStore, HasTheHashOfTheScene) {
  const Store store = read(sample_store());
  Scene scene = make_scene(store);
  // Marks, which earlier versions do not have, are not part of it.
  Json resolved = Json::parse(resolved_store_json(store, scene));
  EXPECT_EQ(resolved.erase("assumed"), 1U);
  EXPECT_EQ(scene.store_hash, content_hash(resolved.dump(1) + "\n"));
  EXPECT_EQ(scene_hash(scene), scene.store_hash);
  const std::string own = hash_without_store(scene);
  EXPECT_NE(own, scene.store_hash);
  EXPECT_EQ(own, hash_without_store(make_scene(store)));
  scene.emitting_surfaces.push_back({"lamp", MaterialId{0}, 1});
  EXPECT_NE(hash_without_store(scene), own);
}

TEST(ResolvedStore, HasAHashThatDoesNotDependOnItsLanguage) {
  auto store = sample_store();
  const Scene english = scene_of(store);
  store["language"] = "de";
  const Scene german = scene_of(store);
  EXPECT_EQ(german.language, Language::german);
  EXPECT_EQ(german.store_hash, english.store_hash);
  EXPECT_EQ(hash_of_resolved(resolved_store_json(read(store), german)), english.store_hash);
  store["name"] = "Another";
  EXPECT_NE(scene_of(store).store_hash, english.store_hash);
}

// Relative sensitivities divide requirements; signals do not depend on them.
TEST(ResolvedStore, HashButNoKeyOfLightCoversSensitivities) {
  const Scene scene = scene_of(sample_store());
  Scene changed = scene;
  changed.labels[0].relative_sensitivity = 1.25;
  EXPECT_NE(hash_without_store(changed), hash_without_store(scene));
  EXPECT_EQ(light_keys(changed).labels, light_keys(scene).labels);
  changed = scene;
  changed.materials[0].reflectance_range = {0.1, 0.9};
  EXPECT_NE(hash_without_store(changed), hash_without_store(scene));
  EXPECT_EQ(light_keys(changed).light_hash, light_keys(scene).light_hash);
}

TEST(ResolvedStore, LightOfEmittingSurfacesHasTheirMaterials) {
  Json text = sample_store();
  const auto hash_of = [&](const std::string& material) {
    Scene scene = scene_of(text);
    for (std::uint32_t m = 0; m < scene.materials.size(); ++m)
      if (scene.materials[m].name == material) scene.emitting_surfaces.push_back({"lamp", MaterialId{m}, 1});
    return light_keys(scene).light_hash;
  };
  const std::string white = hash_of("white");
  EXPECT_NE(hash_of("tile"), white);
  EXPECT_NE(hash_of("carton"), white) << "no surface emits";
  Json materials{{"unused", {{"type", "lambertian"}, {"reflectance", 0.4}}}};
  materials.update(text["materials"]);
  text["materials"] = materials;
  EXPECT_EQ(hash_of("white"), white) << "with another number";
}

}  // namespace
}  // namespace shelfbeam::test
