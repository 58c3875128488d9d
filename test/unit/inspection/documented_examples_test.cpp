// The examples of the documentation cause no warnings.

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/inspection/plausibility.hpp"
#include "shelfbeam/scene/store/store.hpp"

#include "support/documentation.hpp"

namespace shelfbeam {
namespace {

using Json = nlohmann::json;

Json example(const std::string& page) {
  return Json::parse(test::fenced_blocks(page, "jsonc").at(0), nullptr, true, true);
}

void expect_no_warnings(const Json& store) {
  const Scene scene = make_inspected_scene(parse_store(store.dump(), "store.json", {}));
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front().sentence;
}

TEST(DocumentedExamples, CauseNoWarnings) {
  const Json kiosk = example("store.md");
  expect_no_warnings(kiosk);
  Json fixtures = kiosk;
  fixtures.update(example("store/fixtures.md"));
  expect_no_warnings(fixtures);
  Json transceivers = kiosk;
  transceivers["transceivers"] = example("store/transceivers.md");
  expect_no_warnings(transceivers);
  Json variation = kiosk;
  variation.update(example("store/variation.md"));
  variation["variation"].erase("doors");  // of chillers, which the kiosk lacks
  variation["materials"]["clothes"] = {{"type", "lambertian"}, {"reflectance", 0.4}};
  expect_no_warnings(variation);
}

}  // namespace
}  // namespace shelfbeam
