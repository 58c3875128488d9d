#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "system/app/program.hpp"

namespace shelfbeam {
namespace {

using test::Json;

// A shop with a material of every kind, a cabinet with glass doors, several types and tilts, a mesh, and a
// label that faces the wall.
Json shop() {
  Json store = test::small_store();
  store["materials"]["steel"] = {
      {"type", "conductor"}, {"distribution", "ggx"}, {"roughness", 0.5}, {"eta", 1.4}, {"k", 8.0}};
  store["materials"]["mirror"] = {{"type", "conductor"}, {"eta", 0.1}, {"k", 6.0}};
  store["materials"]["pane"] = {{"type", "thin_dielectric"}, {"ior", 1.5}, {"thickness", 0.006}};
  store["materials"]["jar"] = {{"type", "dielectric"}, {"ior", 1.5}};
  store["materials"]["frosted"] = {
      {"type", "dielectric"}, {"ior", 1.5}, {"distribution", "ggx"}, {"roughness", 0.2}};
  store["label_types"]["wide"] = {{"responsivity", {{"type", "cosine_power"}, {"exponent", 2}}},
                                  {"size", {0.1, 0.05}},
                                  {"threshold", 0.01},
                                  {"safety_factor", 2}};
  store["transceiver_types"]["spot"] = {
      {"emission", {{"type", "lambertian"}, {"order", 20}, {"flux", 3}}}, {"radius", 0.05}, {"cost", 2.5}};
  store["fixtures"][0]["doors"] = "pane";
  store["fixtures"].push_back({{"type", "mesh"},
                               {"id", "lens"},
                               {"file", "lens.stl"},
                               {"at", {1, 1, 1}},
                               {"scale", 0.001},
                               {"materials", {{"*", "jar"}}}});
  store["labels"].push_back(
      {{"id", "wrong"}, {"position", {0.02, 2, 1}}, {"normal", {-1, 0, 0}}, {"type", "wide"}});
  const auto unit = [](const char* id, const Json& position, const Json& axis) {
    return Json{{"id", id}, {"position", position}, {"axis", axis}, {"type", "spot"}};
  };
  store["transceivers"]["list"] = {unit("S1", {1, 1, 2.9}, {0, 0, -1}), unit("S2", {1, 1, 2.9}, {1, 0, -1}),
                                   unit("S3", {4, 2, 2.9}, {2, 0, -2}), unit("S4", {4, 2, 2.9}, {0, 1, -1})};
  return store;
}

class Inspect : public test::ProgramTest {
 protected:
  Inspect() {
    folder.write("store.json", shop().dump());
    // A closed corner block of 100 mm.
    std::string stl = "solid lens\n";
    for (const char* corners : {"0 0 0,0 100 0,100 0 0", "0 0 0,100 0 0,0 0 100", "0 0 0,0 0 100,0 100 0",
                                "100 0 0,0 100 0,0 0 100", "100 0 0,50 50 0,0 100 0"}) {
      stl += "facet normal 0 0 0\nouter loop\nvertex ";
      for (const char* c = corners; *c != '\0'; ++c)
        stl += *c == ',' ? std::string("\nvertex ") : std::string(1, *c);
      stl += "\nendloop\nendfacet\n";
    }
    folder.write("lens.stl", stl + "endsolid lens\n");
  }
};

TEST_F(Inspect, PrintsJson) {
  const Json json = Json::parse(told("inspect @store.json --json"));
  const Json& materials = json["materials"];
  const auto number = [&](const char* material, const char* key) {
    return materials[material][key].get<double>();
  };
  EXPECT_EQ(number("m", "reflectance"), 0.3);
  EXPECT_EQ(number("m", "mean_reflectance"), 0.3);
  EXPECT_FALSE(materials["m"].contains("transmittance"));
  EXPECT_NEAR(number("jar", "area_m2"), 0.01 * (1.5 + std::sqrt(3) / 2), 1e-8);
  EXPECT_EQ(materials["jar"]["triangles"], 4);
  EXPECT_EQ(materials["pane"]["triangles"], 4);
  EXPECT_NEAR(number("pane", "area_m2"), 2 * 4 * (1.78 - 0.12), 1e-9);

  // Fresnel at n = 1.5 and normal incidence: F = 0.04; a pane reflects 2 F / (1 + F). The hemispherical
  // reflectance of the surface is 0.0918 (closed form of Walsh); eight points give it to 1e-4. F itself would
  // be rejected.
  EXPECT_NEAR(number("jar", "reflectance"), 0.04, 1e-12);
  EXPECT_NEAR(number("pane", "reflectance"), 0.08 / 1.04, 1e-12);
  EXPECT_NEAR(number("pane", "transmittance"), 0.96 / 1.04, 1e-12);
  EXPECT_NEAR(number("jar", "mean_reflectance"), 0.0918, 1e-4);
  for (const char* glass : {"jar", "pane"})
    EXPECT_NEAR(number(glass, "mean_reflectance") + number(glass, "mean_transmittance"), 1, 1e-9) << glass;
  // Rough glass reflects about as much as smooth glass; its single scattering loses the rest.
  EXPECT_NEAR(number("frosted", "reflectance"), 0.04, 0.004);
  EXPECT_GT(number("frosted", "reflectance") + number("frosted", "transmittance"), 0.97);
  EXPECT_LE(number("frosted", "mean_reflectance") + number("frosted", "mean_transmittance"), 1);
  // A smooth metal at normal incidence: ((eta - 1)^2 + k^2) / ((eta + 1)^2 + k^2).
  EXPECT_NEAR(number("mirror", "reflectance"), (0.81 + 36) / (1.21 + 36), 1e-12);
  EXPECT_LT(number("steel", "reflectance"), (0.16 + 64) / (5.76 + 64) * 0.75) << "rough metal loses light";
  EXPECT_NE(number("steel", "mean_reflectance"), number("steel", "reflectance"));
  EXPECT_NEAR(number("steel", "mean_reflectance"), number("steel", "reflectance"), 0.05);

  EXPECT_EQ(json["label_types"]["standard"]["responsivity"], "cosine");
  EXPECT_EQ(
      json["label_types"]["wide"],
      Json::parse(
          R"({"responsivity": "cosine_power", "size_m": [0.1, 0.05], "labels": 1, "requirement": 0.02})"));
  const Json& spot = json["transceiver_types"]["spot"];
  EXPECT_EQ(spot["emission"], "lambertian");
  EXPECT_EQ(spot["radius_m"], 0.05);
  EXPECT_EQ(spot["flux_w"], 3.0);
  EXPECT_NEAR(spot["peak_w_per_sr"].get<double>(), 3 * 21 / (2 * std::acos(-1.0)), 1e-12);
  EXPECT_EQ(spot["transceivers"], 4);
  EXPECT_EQ(spot["axes"], 3) << "S2 and S3 look the same way";
  EXPECT_EQ(spot["cost"], 2.5);
  EXPECT_DOUBLE_EQ(json["transceiver_types"]["ceiling"]["peak_w_per_sr"].get<double>(), 1);
  // The grid has 4 x 3 points, including S1 and S2; S3 and S4 are at other points.
  EXPECT_EQ(json["transceivers"], 16);
  EXPECT_EQ(json["mounting_points"], 13);
  EXPECT_EQ(json["mounting_points_with_several_options"], 2);

  ASSERT_EQ(json["warnings"].size(), 6u) << json["warnings"].dump(1);
  EXPECT_TRUE(json["warnings"][0].get<std::string>().starts_with(path("store.json") + ": fixtures[1]: "));
  EXPECT_TRUE(json["warnings"][1].get<std::string>().starts_with(path("store.json") + ": labels[1]: "));
}

TEST_F(Inspect, PrintsText) {
  const std::string text = told("inspect @store.json -o @plan.svg");
  for (const char* part :
       {"\n  8.00 x 6.00 x 3.00 m, 940 nm, ", "\n  2 fixtures, 18 labels, 16 candidate transceivers at ",
        " at 13 mounting points, 2 of them with several options\n", "  reflectance  ", "  transmittance  ",
        "\n  pane      thin_dielectric     13.28          4        0.077  0.155          0.923  0.845\n",
        "\n  wide        cosine_power  100 x 50       1         0.02\n",
        "\n  spot              lambertian      0.05       3      10.03      4     3   2.5\n"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\nis not in\n" << text;
  // Results come before tables.
  EXPECT_LT(text.find("\nwarning: "), text.find("\nfloor plan: " + path("plan.svg") + "\n\n"));
  EXPECT_LT(text.find("\nfloor plan: "), text.find("  material  "));
  EXPECT_NE(bytes("plan.svg").find("class=\"door\""), std::string::npos);
}

// A model that inspect wrote is a mesh that it reads, with the triangles of fixtures, labels and units.
TEST_F(Inspect, WritesAModel) {
  const std::string text = told("inspect @store.json -o @store.glb");
  EXPECT_LT(text.find("\nwarning: "), text.find("\n3-D model: " + path("store.glb") + "\n\n"));
  EXPECT_LT(text.find("\n3-D model: "), text.find("  material  "));
  const Json first = Json::parse(told("inspect @store.json --json -o @again.GLB"));
  EXPECT_TRUE(bytes("again.GLB") == bytes("store.glb"));

  Json store = test::small_store();
  store.erase("room");
  store["fixtures"] = {{{"type", "mesh"},
                        {"id", "all"},
                        {"file", "store.glb"},
                        {"at", {0, 0, 0}},
                        {"materials", {{"*", "m"}}}}};
  folder.write("model.json", store.dump());
  const Json second = Json::parse(told("inspect @model.json --json"));
  EXPECT_EQ(second["triangles"], first["triangles"].get<int>() + 2 * first["labels"].get<int>() +
                                     8 * first["transceivers"].get<int>());
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(second["upper"][axis].get<double>(), first["upper"][axis].get<double>(), 2e-5);

  refused("inspect @model.json -o @store.glb", {path("store.glb"), "model.json: fixtures[0]"});
}

TEST_F(Inspect, RefusesUnknownDrawingsBeforeItReads) {
  const std::string remedy = "; use .svg for the floor plan, .glb for the 3-D model or .json for the store\n";
  for (const char* store : {"@store.json", "@missing.json"}) {
    refused(std::string("inspect ") + store + " -o @plan.png",
            {"error: " + path("plan.png") + ": has the unknown extension '.png'" + remedy});
    refused(std::string("inspect ") + store + " -o @plan",
            {"error: " + path("plan") + ": has no extension" + remedy});
  }
}

TEST_F(Inspect, AddsIdsToThePlanIfAskedFor) {
  told("inspect @store.json -o @plan.svg");
  told("inspect @store.json -o @ids.svg --ids");
  EXPECT_EQ(bytes("plan.svg").find(">S3"), std::string::npos);
  EXPECT_NE(bytes("ids.svg").find(">S3 +1<"), std::string::npos) << "S4 is at the same point";
  const std::string error =
      "error: --ids: has no effect without a floor plan; add '-o plan.svg', or remove it\n";
  refused("inspect @store.json --ids", {error});
  refused("inspect @store.json --ids -o @store.glb", {error});
}

TEST_F(Inspect, OmitsTransmittanceWithoutGlass) {
  folder.write("plain.json", test::small_store().dump());
  const std::string text = told("inspect @plain.json");
  EXPECT_EQ(text.find("transmittance"), std::string::npos);
  EXPECT_EQ(text.find("warning"), std::string::npos);
}

TEST_F(Inspect, CountsInnerWallsAndZones) {
  Json store = test::small_store();
  store["room"]["zones"] = {{{"id", "low"}, {"polygon", {{0, 0}, {2, 0}, {2, 2}, {0, 2}}}, {"height", 2.5}}};
  const auto wall = [](const char* id, const Json& from, const Json& to) {
    return Json{{"id", id}, {"from", from}, {"to", to}};
  };
  store["room"]["inner_walls"] = {wall("N", {6.5, 0}, {6.5, 2}), wall("S", {6.5, 4}, {6.5, 6})};
  store["transceivers"]["grids"][0]["z"] = 2.4;
  folder.write("walls.json", store.dump());
  const std::string text = told("inspect @walls.json -o @walls.glb");
  EXPECT_NE(text.find("\n  1 fixtures, 2 inner walls, 1 ceiling zone, 17 labels, "), std::string::npos)
      << text;
  for (const char* node : {"\"N\"", "\"S\"", "\"ceiling low\"", "\"ceiling\"", "\"room\""})
    EXPECT_NE(bytes("walls.glb").find(std::string("\"name\":") + node), std::string::npos) << node;
  const Json counts = Json::parse(told("inspect @walls.json --json"));
  EXPECT_EQ(counts["fixtures"], 1);
  EXPECT_EQ(counts["inner_walls"], 2);
  EXPECT_EQ(counts["ceiling_zones"], 1);
}

}  // namespace
}  // namespace shelfbeam
