#include "support/testing.hpp"
#include "unit/scene/sample_store.hpp"

namespace shelfbeam::test {
namespace {

using testing::ElementsAre;
using testing::StartsWith;

// The sample with other materials for its white ceiling and for the snow in its freezer.
std::vector<std::string> warnings(const Json& white, const Json& snow) {
  Json store = sample_store();
  store["materials"]["white"] = white;
  store["materials"]["snow"] = snow;
  return warnings_of(store);
}

Json diffuse(double reflectance) {
  return {{"type", "lambertian"}, {"reflectance", reflectance}};
}

TEST(BrightMaterials, AreWarnedOf) {
  EXPECT_TRUE(warnings(diffuse(0.96), diffuse(0.97)).empty());
  const Json coated{{"type", "plastic"}, {"ior", 1.5}, {"reflectance", 0.98}};
  EXPECT_THAT(
      warnings(coated, diffuse(1)),
      ElementsAre(StartsWith("store.json: materials.white.reflectance: material 'white' reflects 0.98 "),
                  StartsWith("store.json: materials.snow.reflectance: material 'snow' reflects 1 ")));
  const auto metal = [](double k) {
    return Json{{"type", "conductor"}, {"eta", 0.2}, {"k", k}, {"roughness", 0.1}};
  };
  EXPECT_TRUE(warnings(metal(3), diffuse(0.5)).empty());
  EXPECT_THAT(warnings(metal(30), diffuse(0.5)),
              ElementsAre(StartsWith("store.json: materials.white: material 'white' reflects 0.981 ")));
}

TEST(BrightMaterials, AreNeitherMirrorsNorGlassNorUnused) {
  const Json mirror{{"type", "conductor"}, {"eta", 0}, {"k", 1}}, glass{{"type", "dielectric"}, {"ior", 1.5}};
  EXPECT_TRUE(warnings(mirror, diffuse(0.5)).empty());
  EXPECT_TRUE(warnings(diffuse(0.5), glass).empty());
  Json store = sample_store();
  store["materials"]["unused"] = diffuse(1);
  EXPECT_TRUE(scene_of(store).warnings.empty());
}

}  // namespace
}  // namespace shelfbeam::test
