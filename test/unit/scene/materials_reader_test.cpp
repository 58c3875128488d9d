#include <gtest/gtest.h>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/material/reflectances_940nm.hpp"

#include "support/expect_input_error.hpp"
#include "unit/scene/sample_store.hpp"

namespace shelfbeam {
namespace {

using test::expect_input_error;
using test::Json;

Store with(const std::string& material, double wavelength_nm = 940) {
  Json store = test::sample_store();
  store["wavelength_nm"] = wavelength_nm;
  store["materials"]["tile"] = Json::parse(material);
  return test::read_text(store.dump());
}

template <class Kind>
Kind read(const std::string& material) {
  return std::get<Kind>(with(material).materials[1].material);
}

void expect_error(const std::string& material, const std::string& key, const std::string& message) {
  expect_input_error([&] { with(material); }, "store.json: materials.tile" + key + ": " + message);
}

void expect_facets(const std::optional<Microfacets>& facets, FacetDistribution distribution, double x,
                   double y, Masking masking, FacetSampling sampling) {
  ASSERT_TRUE(facets);
  EXPECT_EQ(facets->distribution, distribution);
  EXPECT_EQ(facets->alpha_x, x);
  EXPECT_EQ(facets->alpha_y, y);
  EXPECT_EQ(facets->masking, masking);
  EXPECT_EQ(facets->sampling, sampling);
}

TEST(MaterialsReader, ReadsConductors) {
  const auto mirror = read<Conductor>(R"({ "type": "conductor", "eta": 1.4, "k": 8 })");
  EXPECT_EQ(mirror.eta, 1.4);
  EXPECT_EQ(mirror.k, 8);
  EXPECT_FALSE(mirror.facets);
  const auto rough = read<Conductor>(R"({ "type": "conductor", "eta": 0, "k": 1, "roughness": 0.3 })");
  expect_facets(rough.facets, FacetDistribution::ggx, 0.3, 0.3, Masking::smith, FacetSampling::visible);
  const auto brushed = read<Conductor>(R"({ "type": "conductor", "eta": 1, "k": 1, "roughness": [0.1, 0.4],
    "distribution": "beckmann", "masking": "cook_torrance" })");
  expect_facets(brushed.facets, FacetDistribution::beckmann, 0.1, 0.4, Masking::cook_torrance,
                FacetSampling::all);
  const auto all = read<Conductor>(R"({ "type": "conductor", "eta": 1, "k": 1, "roughness": 0.2,
    "distribution": "ggx", "masking": "smith", "sampling": "all" })");
  expect_facets(all.facets, FacetDistribution::ggx, 0.2, 0.2, Masking::smith, FacetSampling::all);
}

TEST(MaterialsReader, ReadsPlastic) {
  const auto smooth =
      read<Plastic>(R"({ "type": "plastic", "ior": 1.6, "reflectance": 0.5, "roughness": 0 })");
  EXPECT_EQ(smooth.ior, 1.6);
  EXPECT_EQ(smooth.reflectance, 0.5);
  EXPECT_FALSE(smooth.facets);
  const Plastic made = make_plastic(1.6, 0.5);
  EXPECT_EQ(smooth.albedo({0, 0, 1}), made.albedo({0, 0, 1})) << "made by make_plastic, with its tables";
  const auto rough = read<Plastic>(R"({ "type": "plastic", "ior": 1.5, "reflectance": 0.5, "roughness": 0.2,
    "distribution": "beckmann", "masking": "smith_rational" })");
  expect_facets(rough.facets, FacetDistribution::beckmann, 0.2, 0.2, Masking::smith_rational,
                FacetSampling::all);
}

TEST(MaterialsReader, ReadsGlass) {
  EXPECT_FALSE(read<Dielectric>(R"({ "type": "dielectric", "ior": 1.5 })").facets);
  const auto frosted = read<Dielectric>(R"({ "type": "dielectric", "ior": 1.5, "roughness": [0.2, 0.3] })");
  EXPECT_EQ(frosted.ior, 1.5);
  expect_facets(frosted.facets, FacetDistribution::ggx, 0.2, 0.3, Masking::smith, FacetSampling::visible);
  const auto pane = read<ThinDielectric>(
      R"({ "type": "thin_dielectric", "ior": 1.5, "thickness": 0.006, "absorption_per_m": 2 })");
  EXPECT_EQ(pane.ior, 1.5);
  EXPECT_EQ(pane.thickness, 0.006);
  EXPECT_EQ(pane.absorption_per_m, 2);
  EXPECT_EQ(read<ThinDielectric>(R"({ "type": "thin_dielectric", "ior": 1.5 })").thickness, 0);
}

TEST(MaterialsReader, KnowsReflectancesByName) {
  EXPECT_EQ(read<Lambertian>(R"({ "type": "lambertian", "reflectance": "plaster" })").reflectance, 0.836);
  EXPECT_EQ(
      read<Plastic>(R"({ "type": "plastic", "ior": 1.5, "reflectance": "printed_carton" })").reflectance,
      0.6);
  expect_error(R"({ "type": "lambertian", "reflectance": "plastr" })", ".reflectance",
               "there is no reflectance 'plastr'; did you mean 'plaster'?");
}

TEST(MaterialsReader, NamesAreMeantFor940Nm) {
  const std::string plaster = R"({ "type": "lambertian", "reflectance": "plaster" })";
  for (const double near : {920.0, 950.0, 960.0}) EXPECT_NO_THROW(with(plaster, near)) << near;
  for (const double far : {850.0, 919.9, 960.1, 1550.0})
    expect_input_error([&] { with(plaster, far); },
                       "materials.tile.reflectance: 'plaster' is known at 940 nm, but the store is for",
                       "give its reflectance at that wavelength as a number");
  EXPECT_NO_THROW(with(R"({ "type": "lambertian", "reflectance": 0.8 })", 850));
}

// The names that an editor offers are those that the program knows.
TEST(MaterialsReader, SchemaListsTheNames) {
  const Json schema = Json::parse(read_file(SHELFBEAM_SOURCE_DIR "/data/store.schema.json"));
  Json names = Json::array();
  for (const NamedReflectance& entry : reflectances_940nm()) names.push_back(entry.name);
  EXPECT_GE(names.size(), 25U);
  EXPECT_EQ(schema["$defs"]["reflectance"]["oneOf"][1]["enum"], names);
}

TEST(MaterialsReader, ReadsRangesOfReflectances) {
  const auto range_of = [](const std::string& material) {
    return with(material).materials[1].reflectance_range;
  };
  using Range = std::array<double, 2>;
  EXPECT_EQ(range_of(R"({ "type": "lambertian", "reflectance": 0.5 })"), std::nullopt);
  EXPECT_EQ(range_of(R"({ "type": "lambertian", "reflectance": "plaster" })"), std::nullopt);
  EXPECT_EQ(range_of(R"({ "type": "conductor", "eta": 1, "k": 1 })"), std::nullopt);
  EXPECT_EQ(range_of(R"({ "type": "lambertian", "reflectance": "mixed_goods" })"), (Range{0.3, 0.7}));
  EXPECT_EQ(
      range_of(R"({ "type": "lambertian", "reflectance": "mixed_goods", "reflectance_range": [0.4, 0.5] })"),
      (Range{0.4, 0.5}));
  EXPECT_EQ(
      range_of(R"({ "type": "plastic", "ior": 1.5, "reflectance": 0.4, "reflectance_range": [0.4, 1] })"),
      (Range{0.4, 1}));
  for (const char* wrong : {"[0.6, 0.7]", "[0.3, 0.4]", "[0.7, 0.3]", "[-0.1, 0.6]", "[0.4, 1.1]"})
    expect_error(
        std::string(R"({ "type": "lambertian", "reflectance": 0.5, "reflectance_range": )") + wrong + " }",
        ".reflectance_range", "is from ");
  expect_error(R"({ "type": "lambertian", "reflectance": 0.5, "reflectance_range": [0.4] })",
               ".reflectance_range", "");
}

TEST(MaterialsReader, SaysWhatHasNoEffect) {
  for (const char* key : {"distribution", "masking", "sampling"})
    for (const char* smooth : {"", R"("roughness": 0, )"})
      expect_error(
          std::string(R"({ "type": "conductor", "eta": 1, "k": 1, )") + smooth + '"' + key + R"(": "x" })",
          std::string(".") + key,
          "has no effect on a smooth surface; remove it, or give a 'roughness' above 0");
  const std::string beckmann =
      R"({ "type": "conductor", "eta": 1, "k": 1, "roughness": 0.1, "distribution": "beckmann", )";
  const std::string ggx = R"({ "type": "conductor", "eta": 1, "k": 1, "roughness": 0.1, )";
  expect_error(beckmann + R"("sampling": "visible" })", ".sampling",
               "visible facets can only be sampled for ggx; use 'all'");
  expect_error(ggx + R"("masking": "smith_rational" })", ".masking",
               "approximates the masking of beckmann; ggx has its exact one; use 'smith'");
  expect_error(R"({ "type": "dielectric", "ior": 1.5, "roughness": 0.1, "masking": "cook_torrance" })",
               ".masking", "is only defined for reflection; use 'smith'");
  expect_error(R"({ "type": "thin_dielectric", "ior": 1.5, "absorption_per_m": 2 })", "",
               "has 'absorption_per_m', but no 'thickness'");
}

TEST(MaterialsReader, SaysWhichRoughnessIsAllowed) {
  const auto metal = [](const std::string& roughness) {
    return R"({ "type": "conductor", "eta": 1, "k": 1, "roughness": )" + roughness + " }";
  };
  expect_error(
      metal("0.0005"), ".roughness",
      "is 0.0005, which is outside 0.001 to 1; use a value in that range, or 0 for a smooth surface");
  expect_error(metal("[0.2, 1.5]"), ".roughness[1]", "is 1.5, which is outside 0.001 to 1");
  expect_error(metal("[0.2, 0.2, 0.2]"), ".roughness", "has 3 numbers; 2 are expected");
  expect_error(metal("\"brushed\""), ".roughness", "is a text; a number is expected");
  expect_error(R"({ "type": "plastic", "ior": 1.5, "reflectance": 0.5, "roughness": [0.1, 0.2] })",
               ".roughness", "has two values, but the coat of plastic is the same in all directions");
  expect_error(R"({ "type": "dielectric", "ior": 1.001, "roughness": 0.1 })", ".ior",
               "is 1.001, which is outside 1.01 to 4");
}

}  // namespace
}  // namespace shelfbeam
