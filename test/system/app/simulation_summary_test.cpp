// Tests the lines of `simulate` and `plan` on errors and samples.

#include <cstddef>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shelfbeam/signal/hdf5/signal_file.hpp"

#include "system/app/program.hpp"

namespace shelfbeam {
namespace {

using test::Json;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class SimulationOutput : public test::ProgramTest {
 protected:
  std::string simulated(const std::string& options, int exit_code = 0) const {
    return told("simulate @store.json -o @signal.h5 " + options, exit_code);
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
};

// Two walks per batch find some transceivers only rarely; analytic direct light has no errors.
TEST_F(SimulationOutput, CountsFlaggedEntries) {
  const std::string few = "--estimator uniform --samples 64",
                    exact = "--estimator uniform --direct exact --max-bounces 0";
  const Json json = Json::parse(simulated(few + " --json"));
  const std::size_t count = json["relative_errors"][0]["flagged"];
  EXPECT_GT(count, 0u);
  EXPECT_LE(count, json["relative_errors"][0]["entries"]);
  for (const Json& errors : json["relative_errors"]) EXPECT_EQ(errors["flagged"], flagged(errors["above"]));
  const std::string text = simulated(few);
  EXPECT_THAT(text, HasSubstr("; " + std::to_string(count) + " of them flagged\n"));
  EXPECT_THAT(text, HasSubstr("the error is not reliable"));

  for (const Json& errors : Json::parse(simulated(exact + " --json"))["relative_errors"]) {
    EXPECT_GT(errors["entries"], 0);
    EXPECT_EQ(errors["flagged"], 0);
  }
  EXPECT_THAT(simulated(exact), Not(HasSubstr("flagged")));
}

TEST_F(SimulationOutput, ReportsExtraSamples) {
  const std::string why = ": at least 16 batches are needed to estimate errors\n";
  EXPECT_THAT(simulated("--samples 64"), HasSubstr("\n2096 samples per label instead of 64" + why));
  EXPECT_THAT(told("plan @store.json -o @plan --samples 64 --no-certificate"),
              HasSubstr("\n  2096 samples per label instead of 64" + why));
  const Json json = Json::parse(simulated("--samples 64 --json"));
  EXPECT_EQ(json["asked"], 64);
  EXPECT_EQ(json["samples"], Json({2096, 2096}));
  // Sixteen batches of 131 rays cover 1966 to 2096 samples; the uniform estimator has 32 batches, each of a
  // whole number of samples.
  EXPECT_THAT(simulated("--samples 1965"), HasSubstr("instead of 1965" + why));
  for (const char* options :
       {"--samples 1966", "--samples 2500", "--samples 65 --estimator uniform", "--time 0.1"})
    EXPECT_THAT(simulated(options), Not(HasSubstr("instead of")));
  EXPECT_TRUE(Json::parse(simulated("--time 0.1 --json"))["asked"].is_null());
}

TEST_F(SimulationOutput, BeginsWithTheWarningsOfTheStore) {
  Json store = test::small_store();
  store["materials"]["m"]["reflectance"] = 0.98;
  folder.write("store.json", store.dump());
  const std::string warning =
      "warning: " + path("store.json") + ": materials.m.reflectance: material 'm' reflects 0.98 of the light";
  EXPECT_THAT(simulated("--samples 64 --estimator uniform"), StartsWith(warning));
  EXPECT_THAT(told("plan @store.json -o @plan --samples 64 --estimator uniform --no-certificate"),
              StartsWith(warning));
  const Json json = Json::parse(simulated("--samples 64 --estimator uniform --json"));
  EXPECT_THAT(json["warnings"][0], StartsWith(warning.substr(std::string("warning: ").size())));
  EXPECT_TRUE(json["found_by_chance"].empty());
  EXPECT_EQ(simulated("--samples 64 --estimator uniform --quiet"), "");
  store["materials"]["m"]["reflectance"] = 0.96;
  folder.write("store.json", store.dump());
  EXPECT_THAT(simulated("--samples 64 --estimator uniform"), Not(HasSubstr("warning")));
}

// A run whose error cannot be reached does not succeed; `plan` reports this only without a certificate, which
// would quantify it.
TEST_F(SimulationOutput, NamesTheEntriesThatFallShort) {
  const std::string wanted = "--relative-error 1e-5 --max-samples 9000";
  const std::string text = simulated(wanted, 3);
  EXPECT_THAT(text, HasSubstr("0.001 %"));
  const Json summary = Json::parse(simulated(wanted + " --json", 3));
  EXPECT_EQ(summary["unmet"]["error"], 1e-5);
  EXPECT_GT(summary["unmet"]["entries"], 0);
  EXPECT_LE(summary["samples"][1], 9000);
  const Json& worst = summary["unmet"]["worst"].at(0);
  EXPECT_EQ(worst["out_of_reach"], true);
  EXPECT_THAT(text, HasSubstr("label '" + worst["label"].get<std::string>() + "' from '" +
                              worst["transceiver"].get<std::string>() + "': "));
  EXPECT_THAT(told("plan @store.json -o @plan --no-certificate " + wanted, 3), HasSubstr("0.001 %"));
  EXPECT_THAT(told("plan @store.json -o @plan --overwrite " + wanted, 0), HasSubstr("0.001 %"));
}

}  // namespace
}  // namespace shelfbeam
