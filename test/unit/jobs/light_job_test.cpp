#include "jobs/preview/light_job.hpp"

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/scene/light_keys.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

#include "jobs/preview/light_frame.hpp"
#include "jobs/preview/preview_job.hpp"
#include "support/testing.hpp"
#include "unit/plan/plan_store.hpp"

namespace shelfbeam::jobs {
namespace {

using Json = nlohmann::ordered_json;

std::string text_with(const std::vector<std::string>& selected) {
  const test::PlanStore shop;
  const Store store = parse_store(shop.text(), "store.json", ".");
  Json json = Json::parse(resolved_store_json(store, make_scene(store)));
  json["transceivers"]["selected"] = selected;
  return json.dump();
}

// The messages of a run.
struct Frames {
  std::vector<Json> abouts;
  std::map<std::string, std::string> columns;  // the last frame of each unit

  void operator()(std::string_view frame) {
    abouts.push_back(about_of(frame));
    if (abouts.back()["event"] == "column") columns[abouts.back()["unit"]] = std::string(frame);
  }
  std::vector<std::string> stages() const {
    std::vector<std::string> list;
    for (const Json& about : abouts)
      if (const auto stage = about.value("stage", std::string());
          about["event"] == "column" && (list.empty() || list.back() != stage))
        list.push_back(stage);
    return list;
  }
};

class LightJobOfAShop : public testing::Test {
 protected:
  Frames frames(LightJob job) const {
    job.keep = folder_.path();
    job.folder = folder_.path();
    Frames frames;
    // As a process gets it.
    run_light(light_job_of(input_of(job)), std::ref(frames), {});
    return frames;
  }

  test::TempFolder folder_;
};

TEST_F(LightJobOfAShop, GoesFromDirectLightToSimulatedSignals) {
  const Frames first = frames({.generation = 7, .text = text_with({"T0-0", "T3-2"})});
  EXPECT_EQ(first.stages(), (std::vector<std::string>{"direct", "coarse", "fine", "simulated"}));
  EXPECT_EQ(first.columns.size(), 2U);
  EXPECT_EQ(first.abouts.back()["phase"], "done");
  EXPECT_EQ(first.abouts.back()["operator"], "fine");
  for (const Json& about : first.abouts)
    if (about["event"] == "column") {
      EXPECT_EQ(about["generation"], 7);
    }
  const Frames again = frames({.generation = 8, .text = text_with({"T0-0", "T3-2"})});
  EXPECT_EQ(again.stages(), (std::vector<std::string>{"fine", "simulated"})) << "the operator is kept";
  LightJob known{.generation = 8, .text = text_with({"T0-0", "T1-1"})};
  for (const auto& [unit, frame] : again.columns) known.known.push_back(frame);
  const Frames third = frames(known);
  EXPECT_EQ(third.stages(), (std::vector<std::string>{"fine", "simulated"}));
  EXPECT_EQ(third.columns.size(), 1U) << "one of the units is known";
}

// The signals of all labels from two units are those of a simulation: z-scores of 32 signals have a root mean
// square of 1 +- 0.13; the light of paths that the labels share correlates them. 5 % more is refused.
TEST_F(LightJobOfAShop, AgreesWithASimulation) {
  const std::string text = text_with({"T0-0", "T3-2"});
  const Frames frames = this->frames({.text = text});
  const Scene scene = make_scene(parse_store(text, "store.json", "."));
  SimulationOptions options;
  options.samples = 40000;
  options.direct = DirectLight::exact;
  const SignalMatrix truth = simulate(scene, options).matrix;
  const std::vector<std::uint64_t> keys = light_keys_of(scene, scene.transceivers);
  double squares = 0, wrong = 0;
  int count = 0;
  for (std::size_t j = 0; j < keys.size(); ++j) {
    const auto found = frames.columns.find(unit_key(keys[j]));
    EXPECT_EQ(found != frames.columns.end(), scene.transceivers[j].selected);
    if (found == frames.columns.end()) continue;
    const Preview column = column_of(found->second);
    for (std::size_t i = 0; i < column.signal.size(); ++i, ++count) {
      const std::size_t e = truth.at(i, j);
      const double signal = static_cast<double>(column.signal[i]), mean = static_cast<double>(truth.mean[e]);
      const double spread =
          std::hypot(static_cast<double>(column.error[i]), static_cast<double>(truth.standard_error[e]));
      squares += std::pow((signal - mean) / spread, 2);
      wrong += std::pow((1.05 * signal - mean) / spread, 2);
    }
  }
  EXPECT_NEAR(std::sqrt(squares / count), 1, 0.45);
  EXPECT_GT(std::sqrt(wrong / count), 1.45);
}

TEST_F(LightJobOfAShop, PreparesTheOperatorForTheFirstUnit) {
  const Frames frames = this->frames({.text = text_with({})});
  EXPECT_TRUE(frames.columns.empty());
  EXPECT_EQ(frames.abouts.back()["phase"], "none");
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / operator_name));
}

TEST_F(LightJobOfAShop, NeedsLabels) {
  Json store = Json::parse(text_with({}));
  store["labels"] = Json::array();
  EXPECT_THROW(frames({.text = store.dump()}), InputError);
  EXPECT_THROW(light_job_of("nothing"), std::exception);
  EXPECT_THROW(light_job_of("{}\n"), std::exception);
}

}  // namespace
}  // namespace shelfbeam::jobs
