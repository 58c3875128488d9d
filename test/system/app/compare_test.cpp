#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "shelfbeam/base/csv.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"

#include "system/app/program.hpp"

namespace shelfbeam {
namespace {

using test::Json;

/// A simulated kiosk and measurements there in millivolts: 250 per W/m^2, up to 0.3 dB off.
class Compare : public test::ProgramTest {
 protected:
  Compare() {
    told("simulate @store.json -o @signal.h5 --samples 4000");
    matrix = read_signal_file(folder / "signal.h5");
  }
  double noise(std::size_t k) const {
    return std::pow(10, 0.03 * std::sin(12.9898 * static_cast<double>(k)));
  }

  std::string pairs() const {
    std::string csv = "label,transceiver,signal,error\n";
    for (std::size_t i = 0; i < matrix.rows(); ++i)
      for (std::size_t j = 0; j < matrix.columns(); ++j) {
        const double value = 250 * static_cast<double>(matrix.mean[matrix.at(i, j)]) * noise(matrix.at(i, j));
        csv += fmt::format("{},{},{},{}\n", csv_field(matrix.labels[i].id), matrix.transceivers[j].id, value,
                           0.06 * value + 0.01);
      }
    return csv;
  }

  SignalMatrix matrix;
};

TEST_F(Compare, FindsTheFactorOfPairs) {
  folder.write("m.csv", pairs());
  const std::string text = told("compare @signal.h5 @m.csv -o @out");
  for (const char* part : {"times the simulated signals", "errors explain the differences",
                           "No pair is an outlier.", "comparison.csv", "comparison.html"})
    EXPECT_NE(text.find(part), std::string::npos) << part << '\n' << text;
  EXPECT_EQ(test::names(folder / "out"), (std::set<std::string>{"comparison.csv", "comparison.html"}));
  const Json json = Json::parse(told("compare @signal.h5 @m.csv --json"));
  EXPECT_EQ(json["pairs"], matrix.rows() * matrix.columns());
  EXPECT_LT(json["factor_low"], 250);
  EXPECT_GT(json["factor_high"], 250);
  EXPECT_NEAR(json["factor"].get<double>(), 250, 5);
  EXPECT_EQ(json["one_factor"], true);
  EXPECT_EQ(json["outliers"].size(), 0u);
  // The measured value of one label is far too large.
  std::string wrong = pairs();
  const std::size_t line = wrong.find("\ndoor,");
  wrong.insert(wrong.find(',', wrong.find(',', line + 1) + 1) + 1, "9");
  folder.write("wrong.csv", wrong);
  const Json found = Json::parse(told("compare @signal.h5 @wrong.csv --json"));
  ASSERT_EQ(found["outliers"].size(), 1u) << found;
  EXPECT_EQ(found["outliers"][0]["label"], "door");
  EXPECT_EQ(found["one_factor"], false);
}

TEST_F(Compare, FindsTheFactorOfAPlacement) {
  told("place @signal.h5 -o @placement.json");
  const Json placement = Json::parse(read_file(folder / "placement.json"));
  std::string csv = "label,signal\n";
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < matrix.columns(); ++j)
      for (const Json& id : placement["selected"])
        if (id == matrix.transceivers[j].id) sum += static_cast<double>(matrix.mean[matrix.at(i, j)]);
    csv += fmt::format("{},{}\n", csv_field(matrix.labels[i].id), 8 * sum * noise(i));
  }
  folder.write("m.csv", csv);
  const Json json =
      Json::parse(told("compare @signal.h5 @m.csv --placement @placement.json --json -o @c.html"));
  EXPECT_EQ(json["report"], path("c.html"));
  EXPECT_TRUE(read_file(folder / "c.html").starts_with("<!DOCTYPE html>"));
  EXPECT_LT(json["factor_low"], 8);
  EXPECT_GT(json["factor_high"], 8);
  EXPECT_TRUE(json["p_value"].is_null());
  EXPECT_EQ(json["worst"][0]["transceiver"], nullptr);
}

// Ratios and squares of these values would overflow.
TEST_F(Compare, RefusesValuesBeyondItsRange) {
  const std::string head = "label,transceiver,signal,error\ndoor,G1-1-1,";
  for (const auto& [values, problem] : std::vector<std::pair<std::string, std::string>>{
           {"1e160,1", "field 3: is greater than 1e18"},
           {"-1e160,1", "field 3: is less than -1e18"},
           {"1,1e160", "field 4: is greater than 1e18"},
           {"1e-160,1", "field 3: is 1e-160, which is nearer to 0 than 1e-18"},
           {"1,1e-160", "field 4: is 1e-160, which is nearer to 0 than 1e-18"}}) {
    folder.write("m.csv", head + values + "\n");
    refused("compare @signal.h5 @m.csv", {"m.csv: line 2, " + problem});
  }
  // Control: the limits themselves.
  folder.write("m.csv", head + "1e18,1e-18\ndoor,G1-2-1,-1e18,1e18\ndoor,G1-3-1,1e-18,1\ndoor,G1-4-1,0,1\n");
  const test::Outcome outcome = test::shelfbeam(test::words(folder, "compare @signal.h5 @m.csv"));
  EXPECT_LT(outcome.exit_code, 3) << outcome.err;
}

TEST_F(Compare, RefusesIncomparableInput) {
  const auto refuse = [&](const std::string& csv, const std::string& options,
                          const std::vector<std::string>& parts) {
    folder.write("m.csv", csv);
    refused("compare @signal.h5 @m.csv " + options, parts);
  };
  const std::string good = pairs();
  folder.write("placement.json", "{}");
  refuse("label,signal\ndoor,1\n", "", {"m.csv", "--placement"});
  refuse("label,transceiver,signal\ndor,G1-1-1,1\n", "", {"m.csv: line 2", "'door'"});
  refuse("label,transceiver,signal\ndoor,G1-1-1,1\n", "", {"m.csv", "three"});
  refuse(good, "--placement @placement.json", {"remove --placement"});
  refuse(good, "-o @m.csv", {"m.csv: "});
  refuse(good, "-o @page.txt", {".csv or .html"});
  refuse(good, "-o @missing/page.html", {"missing"});
  refuse(good, "--confidence 1", {"--confidence"});
}

}  // namespace
}  // namespace shelfbeam
