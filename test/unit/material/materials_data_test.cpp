#include <nlohmann/json.hpp>

#include "shelfbeam/material/optics/fresnel.hpp"
#include "shelfbeam/material/reflectances_940nm.hpp"
#include "shelfbeam/math/warp.hpp"

#include "support/testing.hpp"

namespace shelfbeam::test {
namespace {

using Json = nlohmann::json;

Json read_data() {
  std::ifstream file(SHELFBEAM_SOURCE_DIR "/data/materials_940nm.json");
  return Json::parse(file);
}

/// The problem of an entry; empty for a valid entry.
std::string problem(const Json& entry, const Json& sources) {
  const double value = entry.value("reflectance", -1.0);
  if (!(value > 0 && value < 1)) return "its reflectance is not between 0 and 1";
  const bool measured = entry.value("measured", false), assumed = entry.value("assumption", false);
  if (measured == assumed) return "it must be either measured or an assumption";
  const std::string source = entry.value("source", "");
  if (!sources.contains(source)) return "its source is not listed";
  if (assumed != (source == "assumption")) return "only an assumption has no source";
  if (measured && !sources[source]["address"].is_string()) return "its source has no address";
  if (assumed && !entry.contains("range")) return "an assumption needs a range";
  if (entry.contains("range")) {
    const double low = entry["range"].at(0), high = entry["range"].at(1);
    if (!(0 <= low && low < high && high <= 1 && low <= value && value <= high))
      return "its range does not hold it";
  }
  if (entry.value("note", "").empty()) return "it has no note";
  return {};
}

TEST(MaterialsData, EveryReflectanceHasASourceOrARange) {
  const Json data = read_data();
  EXPECT_EQ(data["wavelength_nm"], 940);
  EXPECT_GE(data["reflectances"].size(), 25U);
  std::size_t measured = 0;
  for (const auto& [name, entry] : data["reflectances"].items()) {
    EXPECT_EQ(problem(entry, data["sources"]), "") << name;
    measured += entry.contains("measured");
  }
  EXPECT_GE(measured, 15U);
}

TEST(MaterialsData, CheckFindsMissingEntries) {
  const Json data = read_data(), good = data["reflectances"]["ceiling_tile"];
  const auto with = [&](const char* key, const Json& value) {
    Json entry = good;
    entry[key] = value;
    return problem(entry, data["sources"]);
  };
  EXPECT_EQ(problem(good, data["sources"]), "");
  EXPECT_NE(with("reflectance", 1.2), "");
  EXPECT_NE(with("reflectance", 0.5), "");  // outside its range
  EXPECT_NE(with("measured", true), "");
  EXPECT_NE(with("assumption", false), "");
  EXPECT_NE(with("source", "hearsay"), "");
  EXPECT_NE(with("source", "owcsimpy"), "");
  EXPECT_NE(with("range", Json::array({0.9, 0.7})), "");
}

TEST(MaterialsData, ProgramKnowsAllReflectances) {
  const Json data = read_data();
  EXPECT_EQ(reflectances_940nm().size(), data["reflectances"].size());
  for (const NamedReflectance& entry : reflectances_940nm()) {
    const Json& listed = data["reflectances"][entry.name];
    EXPECT_EQ(listed["reflectance"], entry.reflectance) << entry.name;
    EXPECT_EQ(listed.value("range", Json()), entry.range ? Json(*entry.range) : Json()) << entry.name;
  }
}

// The known values from the project's sources.
TEST(MaterialsData, HasTheKnownValues) {
  const Json data = read_data();
  for (const auto& [name, value] : {std::pair{"plaster", 0.836},
                                    {"office_floor", 0.633},
                                    {"cotton", 0.635},
                                    {"skin", 0.586},
                                    {"pine", 0.915},
                                    {"black_gloss_paint", 0.038},
                                    {"grey_cardboard", 0.2},
                                    {"grey_pvc", 0.5},
                                    {"white_paper", 0.8}})
    EXPECT_EQ(data["reflectances"][name]["reflectance"], value) << name;
}

// Two independent measurements of aluminium agree within 0.03: optical constants and total reflectance.
// Absorption and extinction agree to the three digits of absorption.
TEST(MaterialsData, OpticalConstantsAgreeWithReflectances) {
  const Json data = read_data(), &indices = data["indices"];
  const auto normal = [&](const char* name) {
    return fresnel_conductor(1, indices[name]["eta"], indices[name]["k"]);
  };
  const double aluminium = data["reflectances"]["aluminium"]["reflectance"];
  EXPECT_NEAR(normal("aluminium"), aluminium, 0.03);
  EXPECT_GT(std::abs(normal("iron") - aluminium), 0.03);  // control
  for (const char* glass : {"window_glass", "low_iron_glass"}) {
    const double expected = 4 * pi * indices[glass]["extinction"].get<double>() / 940e-9;
    EXPECT_NEAR(indices[glass]["absorption_per_m"], expected, 5e-3 * expected);
    EXPECT_TRUE(indices[glass]["address"].is_string());
  }
}

}  // namespace
}  // namespace shelfbeam::test
