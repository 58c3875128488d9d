#include "shelfbeam/base/file.hpp"
#include "shelfbeam/device/photometry/photometry.hpp"

#include "support/testing.hpp"
#include "unit/scene/sample_store.hpp"

namespace shelfbeam::test {
namespace {

const std::filesystem::path profiles = SHELFBEAM_SOURCE_DIR "/data/photometry";

TransceiverType type_with(const Json& emission, const std::filesystem::path& folder) {
  Json store = sample_store();
  store["transceiver_types"]["down"]["emission"] = emission;
  store["label_types"]["deep"]["threshold"] = 1;  // it had a range for `down`
  return read(store, folder).transceiver_types.at(0);
}

Json file(const char* type, const char* name, double flux) {
  return {{"type", type}, {"file", name}, {"flux", flux}};
}

TEST(EmissionReader, TakesTheShapeOfAFileAndTheFluxOfTheStore) {
  for (const auto& [type, name] : {std::pair{"ies", "batwing.ies"}, {"eulumdat", "batwing.ldt"}}) {
    const TransceiverType unit = type_with(file(type, name, 0.8), profiles);
    EXPECT_NEAR(power(unit.emission), 0.8, 1e-14);
    const auto& table = std::get<EmissionTable>(unit.emission).intensity;
    const DirectionTable whole =
        std::string(type) == "ies" ? read_ies(profiles / name) : read_eulumdat(profiles / name);
    EXPECT_EQ(table.theta(), whole.theta());
    EXPECT_EQ(table.phi(), whole.phi());
    EXPECT_EQ(table.values(), whole.with_integral(0.8).values());
  }
}

TEST(EmissionReader, LooksForFilesBesideTheStore) {
  const TempFolder folder;
  folder.write("profiles/a.ies", read_file(profiles / "batwing.ies"));
  EXPECT_NO_THROW(type_with(file("ies", "profiles/a.ies", 1), folder.path()));
  for (const char* wrong : {"a.ies", "profiles"})
    expect_input_error([&] { type_with(file("ies", wrong, 1), folder.path()); },
                       "store.json: transceiver_types.down.emission.file: ", (folder / wrong).string());
}

TEST(EmissionReader, ErrorsNameFileAndLine) {
  const TempFolder folder;
  const std::string text = read_file(profiles / "batwing.ies");
  folder.write("cut.ies", text.substr(0, text.size() / 2));
  expect_input_error(
      [&] { type_with(file("ies", "cut.ies", 1), folder.path()); },
      "store.json: transceiver_types.down.emission.file: " + (folder / "cut.ies").string() + ": line ");
  expect_input_error([&] { type_with(file("eulumdat", "batwing.ies", 1), profiles); },
                     (profiles / "batwing.ies").string() + ": line ");
}

TEST(EmissionReader, RefusesAFluxThatMakesTooMuchIntensity) {
  expect_input_error([&] { type_with(file("ies", "narrow-aisle.ies", 1e9), profiles); },
                     "transceiver_types.down.emission.flux: ", "W/sr");
}

TEST(EmissionReader, TablesMayOmitTheAxis) {
  const auto unit =
      type_with({{"type", "table"}, {"theta_deg", {90, 120, 180}}, {"intensity", {1, 2, 0}}}, {});
  const auto& table = std::get<EmissionTable>(unit.emission).intensity;
  EXPECT_EQ(table.value(0.5, 0), 0);
  EXPECT_GT(table.value(2, 0), 1);
}

}  // namespace
}  // namespace shelfbeam::test
