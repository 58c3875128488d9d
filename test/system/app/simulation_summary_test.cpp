// What `simulate` and `plan` say of errors and samples.

#include <cstddef>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shelfbeam/signal/hdf5/signal_file.hpp"

#include "system/app/program.hpp"

namespace shelfbeam {
namespace {

using test::expect_silent;
using test::Json;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class SimulationSummary : public testing::Test {
 protected:
  SimulationSummary() { folder.write("store.json", test::small_store().dump()); }

  std::string simulated(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(),
                     {"simulate", (folder / "store.json").string(), "-o", (folder / "signal.h5").string()});
    return expect_silent(std::move(arguments));
  }

  // Flagged entries above a share of their label's requirement.
  std::size_t flagged(double share) const {
    const SignalMatrix matrix = read_signal_file(folder / "signal.h5");
    std::size_t count = 0;
    for (std::size_t i = 0; i < matrix.rows(); ++i)
      for (std::size_t j = 0; j < matrix.columns(); ++j)
        if (static_cast<double>(matrix.mean[matrix.at(i, j)]) > share * matrix.labels[i].requirement)
          count += matrix.is_flagged(matrix.at(i, j)) ? 1 : 0;
    return count;
  }

  test::TempFolder folder;
};

// Two walks a batch find some of the transceivers now and then; direct light in closed form has no errors.
TEST_F(SimulationSummary, CountsFlaggedEntries) {
  const std::vector<std::string> few{"--estimator", "uniform", "--samples", "64"},
      exact{"--estimator", "uniform", "--direct", "exact", "--max-bounces", "0"};
  const auto with_json = [](std::vector<std::string> arguments) {
    arguments.emplace_back("--json");
    return arguments;
  };
  const Json json = Json::parse(simulated(with_json(few)));
  const std::size_t count = json["relative_errors"][0]["flagged"];
  EXPECT_GT(count, 0u);
  EXPECT_LE(count, json["relative_errors"][0]["entries"]);
  for (const Json& errors : json["relative_errors"]) EXPECT_EQ(errors["flagged"], flagged(errors["above"]));
  const std::string text = simulated(few);
  EXPECT_THAT(text, HasSubstr("; " + std::to_string(count) + " of them flagged\n"));
  EXPECT_THAT(text, HasSubstr("the error is not to be trusted"));

  for (const Json& errors : Json::parse(simulated(with_json(exact)))["relative_errors"]) {
    EXPECT_GT(errors["entries"], 0);
    EXPECT_EQ(errors["flagged"], 0);
  }
  EXPECT_THAT(simulated(exact), Not(HasSubstr("flagged")));
}

TEST_F(SimulationSummary, SaysWhereMoreSamplesAreTakenThanAskedFor) {
  const std::string why = ": at least 16 batches are needed to estimate errors\n";
  EXPECT_THAT(simulated({"--samples", "64"}), HasSubstr("\n2096 samples per label instead of 64" + why));
  const Json json = Json::parse(simulated({"--samples", "64", "--json"}));
  EXPECT_EQ(json["asked"], 64);
  EXPECT_EQ(json["samples"], Json({2096, 2096}));
  // Sixteen batches of 131 rays have room for 1966 to 2096; of uniform there are 32, each a whole number.
  EXPECT_THAT(simulated({"--samples", "1965"}), HasSubstr("instead of 1965" + why));
  EXPECT_THAT(simulated({"--samples", "1966"}), Not(HasSubstr("instead of")));
  EXPECT_THAT(simulated({"--samples", "2500"}), Not(HasSubstr("instead of")));
  EXPECT_THAT(simulated({"--samples", "65", "--estimator", "uniform"}), Not(HasSubstr("instead of")));
  EXPECT_TRUE(Json::parse(simulated({"--time", "0.1", "--json"}))["asked"].is_null());
  EXPECT_THAT(simulated({"--time", "0.1"}), Not(HasSubstr("instead of")));
}

TEST_F(SimulationSummary, BeginsWithTheWarningsOfTheStore) {
  Json store = test::small_store();
  store["materials"]["m"]["reflectance"] = 0.98;
  folder.write("store.json", store.dump());
  const std::string warning = "warning: " + (folder / "store.json").string() +
                              ": materials.m.reflectance: material 'm' reflects 0.98 of the light";
  EXPECT_THAT(simulated({"--samples", "64"}), StartsWith(warning));
  EXPECT_THAT(expect_silent({"plan", (folder / "store.json").string(), "-o", (folder / "plan").string(),
                             "--samples", "64", "--no-certificate"}),
              StartsWith(warning));
  const Json json = Json::parse(simulated({"--samples", "64", "--json"}));
  EXPECT_THAT(json["warnings"][0], StartsWith(warning.substr(std::string("warning: ").size())));
  EXPECT_TRUE(json["found_by_chance"].empty());
  EXPECT_EQ(simulated({"--samples", "64", "--quiet"}), "");
  store["materials"]["m"]["reflectance"] = 0.96;
  folder.write("store.json", store.dump());
  EXPECT_THAT(simulated({"--samples", "64"}), Not(HasSubstr("warning")));
}

// An error out of reach is no success: of `plan` only where no certificate says what it is worth.
TEST_F(SimulationSummary, NamesTheEntriesThatFallShort) {
  const std::string store = (folder / "store.json").string(), plan = (folder / "plan").string();
  const std::vector<std::string> wanted{"--relative-error", "1e-5", "--max-samples", "9000"};
  const auto with = [&](std::vector<std::string> first, const std::vector<std::string>& last = {}) {
    first.insert(first.end(), wanted.begin(), wanted.end());
    first.insert(first.end(), last.begin(), last.end());
    return first;
  };
  const auto simulate = with({"simulate", store, "-o", (folder / "m.h5").string()});
  EXPECT_THAT(expect_silent(simulate, 3), HasSubstr("0.001 %"));
  auto json = simulate;
  json.push_back("--json");
  const Json summary = Json::parse(expect_silent(json, 3));
  EXPECT_EQ(summary["unmet"]["error"], 1e-5);
  EXPECT_GT(summary["unmet"]["entries"], 0);
  EXPECT_FALSE(summary["unmet"]["worst"].empty());
  EXPECT_LE(summary["samples"][1], 9000);
  const Json& worst = summary["unmet"]["worst"][0];
  EXPECT_EQ(worst["out_of_reach"], true);
  EXPECT_THAT(expect_silent(simulate, 3),
              HasSubstr("label '" + worst["label"].get<std::string>() + "' from '" +
                        worst["transceiver"].get<std::string>() + "': "));
  EXPECT_THAT(expect_silent(with({"plan", store, "-o", plan}, {"--no-certificate"}), 3),
              HasSubstr("0.001 %"));
  EXPECT_THAT(expect_silent(with({"plan", store, "-o", plan}), 0), HasSubstr("0.001 %"));
}

TEST_F(SimulationSummary, OfAPlanIsTheSame) {
  const std::string text = expect_silent({"plan", (folder / "store.json").string(), "-o",
                                          (folder / "plan").string(), "--samples", "64", "--no-certificate"});
  EXPECT_THAT(text, HasSubstr("\n2096 samples per label instead of 64: "));
}

}  // namespace
}  // namespace shelfbeam
