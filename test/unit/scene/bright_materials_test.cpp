#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "unit/scene/sample_store.hpp"

namespace shelfbeam {
namespace {

using test::Json;

// The sample, whose ceiling is white and whose freezer holds snow, with other materials for these.
std::vector<std::string> warnings(const Json& white, const Json& snow) {
  Json store = test::sample_store();
  store["materials"]["white"] = white;
  store["materials"]["snow"] = snow;
  return test::scene_of(store).warnings;
}

Json diffuse(double reflectance) {
  return {{"type", "lambertian"}, {"reflectance", reflectance}};
}

TEST(BrightMaterials, AreWarnedOf) {
  EXPECT_TRUE(warnings(diffuse(0.96), diffuse(0.97)).empty());
  const Json coated{{"type", "plastic"}, {"ior", 1.5}, {"reflectance", 0.98}};
  const std::string consequence =
      " of the light, so that paths between such surfaces end late: simulation takes long, and its errors "
      "are less reliable; white paint has 0.8 to 0.9, rough metal 0.6 to 0.9";
  EXPECT_EQ(warnings(coated, diffuse(1)),
            (std::vector<std::string>{
                "store.json: materials.white.reflectance: material 'white' reflects 0.98" + consequence,
                "store.json: materials.snow.reflectance: material 'snow' reflects 1" + consequence}));
  const auto metal = [](double k) {
    return Json{{"type", "conductor"}, {"eta", 0.2}, {"k", k}, {"roughness", 0.1}};
  };
  EXPECT_TRUE(warnings(metal(3), diffuse(0.5)).empty());
  EXPECT_EQ(warnings(metal(30), diffuse(0.5)),
            (std::vector<std::string>{"store.json: materials.white: material 'white' reflects 0.981" +
                                      consequence}));
}

TEST(BrightMaterials, AreNeitherMirrorsNorGlassNorUnused) {
  const Json mirror{{"type", "conductor"}, {"eta", 0}, {"k", 1}}, glass{{"type", "dielectric"}, {"ior", 1.5}};
  EXPECT_TRUE(warnings(mirror, diffuse(0.5)).empty());
  EXPECT_TRUE(warnings(diffuse(0.5), glass).empty());
  Json store = test::sample_store();
  store["materials"]["unused"] = diffuse(1);
  EXPECT_TRUE(test::scene_of(store).warnings.empty());
}

}  // namespace
}  // namespace shelfbeam
