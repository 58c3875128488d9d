#include "shelfbeam/base/file.hpp"
#include "shelfbeam/material/reflectances_940nm.hpp"
#include "shelfbeam/scene/field_writer.hpp"
#include "shelfbeam/scene/store/device_fields.hpp"

#include "support/testing.hpp"
#include "unit/scene/sample_store.hpp"

namespace shelfbeam::test {
namespace {

Store with(const std::string& material) {
  return read(changed_store("/materials/tile", material));
}

template <class Kind>
Kind material_of(const std::string& material) {
  return std::get<Kind>(with(material).materials[1].material);
}

TEST(MaterialsReader, ReadsEveryType) {
  const auto metal =
      material_of<Conductor>(R"({ "type": "conductor", "eta": 1.4, "k": 8, "roughness": [0.1, 0.4] })");
  EXPECT_EQ((std::array{metal.eta, metal.k, metal.facets->alpha_x, metal.facets->alpha_y}),
            (std::array{1.4, 8.0, 0.1, 0.4}));
  const auto plastic = material_of<Plastic>(R"({ "type": "plastic", "ior": 1.6, "reflectance": 0.5 })");
  EXPECT_EQ(plastic.albedo({0, 0, 1}), make_plastic(1.6, 0.5).albedo({0, 0, 1})) << "with its tables";
  EXPECT_EQ(material_of<Dielectric>(R"({ "type": "dielectric", "ior": 1.4 })").ior, 1.4);
  const auto pane = material_of<ThinDielectric>(
      R"({ "type": "thin_dielectric", "ior": 1.5, "thickness": 0.006, "absorption_per_m": 2 })");
  EXPECT_EQ((std::array{pane.ior, pane.thickness, pane.absorption_per_m}), (std::array{1.5, 0.006, 2.0}));
}

// The keys of a material in the resolved store.
TEST(MaterialsReader, FillsInDefaults) {
  const std::string metal = R"({ "type": "conductor", "eta": 0, "k": 1, "roughness": )";
  const std::string rough = R"({ "distribution": "ggx", "masking": "smith", "sampling": "visible" })";
  for (const auto& [given, more] : std::vector<std::pair<std::string, std::string>>{
           {R"({ "type": "conductor", "eta": 1.4, "k": 8 })", "{}"},
           {metal + "0.3 }", rough},
           {metal + R"([0.1, 0.4], "distribution": "beckmann", "masking": "cook_torrance" })",
            R"({ "sampling": "all" })"},
           {metal + R"(0.2, "distribution": "ggx", "masking": "smith", "sampling": "all" })", "{}"},
           {R"({ "type": "plastic", "ior": 1.6, "reflectance": 0.5, "roughness": 0 })",
            R"({ "roughness": null })"},
           {R"({ "type": "plastic", "ior": 1.5, "reflectance": "printed_carton", "roughness": 0.2,
                 "distribution": "beckmann", "masking": "smith_rational" })",
            R"({ "reflectance": 0.6, "sampling": "all", "reflectance_range": [0.3, 0.8] })"},
           {R"({ "type": "dielectric", "ior": 1.5 })", "{}"},
           {R"({ "type": "dielectric", "ior": 1.5, "roughness": [0.2, 0.3] })", rough},
           {R"({ "type": "thin_dielectric", "ior": 1.5 })", R"({ "thickness": 0, "absorption_per_m": 0 })"},
           {R"({ "type": "lambertian", "reflectance": "plaster" })", R"({ "reflectance": 0.836 })"}}) {
    Json expected = Json::parse(given);
    expected.merge_patch(Json::parse(more));
    Store store = with(given);
    Json written;
    FieldWriter writer(written, {store.materials, store.label_types, store.transceiver_types});
    describe(store.materials[1], writer);
    EXPECT_EQ(written, expected) << given;
  }
}

// The names in the schema, which an editor offers, are those that the program knows.
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
}

}  // namespace
}  // namespace shelfbeam::test
