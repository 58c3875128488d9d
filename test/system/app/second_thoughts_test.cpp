// Tests plans that reuse the signals of earlier ones through the program.

#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shelfbeam/signal/hdf5/signal_file.hpp"

#include "system/app/program.hpp"

namespace shelfbeam {
namespace {

using testing::HasSubstr;

class SecondThoughts : public test::ProgramTest {
 protected:
  void write(const test::Json& store) const { folder.write("store.json", store.dump()); }
  SignalMatrix signals(const std::string& plan) const {
    return read_signal_file(folder / plan / "signal.h5");
  }
};

constexpr auto plan = "plan @store.json --samples 1000 --no-certificate";

TEST_F(SecondThoughts, AboutPricesAndRequirementsKeepTheSignals) {
  test::Json store = test::small_store();
  write(store);
  told(fmt::format("{} -o @first", plan));
  store["transceiver_types"]["ceiling"]["cost"] = 7;
  store["label_types"]["standard"]["safety_factor"] = 1.1;
  store["name"] = "another name";
  write(store);
  const std::string again =
      "plan @store.json --no-certificate --survive-failure --signal @first --seed 2 -o @second";
  EXPECT_THAT(told(again), HasSubstr("read from "));
  const SignalMatrix first = signals("first"), second = signals("second");
  EXPECT_EQ(second.mean, first.mean);
  EXPECT_EQ(second.standard_error, first.standard_error);
  EXPECT_EQ(second.transceivers[0].cost, 7);
  EXPECT_NE(second.provenance.store_hash, first.provenance.store_hash);
  EXPECT_EQ(json("second/run.json")["signals"]["reused"], true);

  // The same placement as from a file with these signals.
  told("place @second/signal.h5 --survive-failure -o @placed.json");
  EXPECT_EQ(json("placed.json")["chosen"], json("second/placement.json")["chosen"]);
}

TEST_F(SecondThoughts, AboutTheShopAreSimulatedAgain) {
  test::Json store = test::small_store();
  write(store);
  told(fmt::format("{} -o @first", plan));
  const auto expect_again = [&](const std::string& misfit, const std::string& reason) {
    write(store);
    const std::string text = told("plan @store.json --no-certificate --signal @first --overwrite -o @second");
    EXPECT_THAT(text, HasSubstr(reason));
    EXPECT_THAT(text, HasSubstr("simulated again: "));
    EXPECT_EQ(json("second/run.json")["signals"]["misfit"], misfit);
    EXPECT_NE(signals("second").mean, signals("first").mean);
  };
  store["labels"][0].update({{"id", "new"}, {"position", {0.1, 2, 1.5}}});
  expect_again("labels", "lacks the label 'new'");
  store = test::small_store();
  store["materials"]["m"]["reflectance"] = 0.123;
  expect_again("light", "a material or the wavelength has changed");
}

TEST_F(SecondThoughts, ReadPlansOfEarlierVersions) {
  for (const char* version : {"0.1.0", "0.2.0", "0.3.0"}) {
    const std::filesystem::path old =
        std::filesystem::path(SHELFBEAM_SOURCE_DIR "/test/system/compatibility") / version;
    test::Json store = test::Json::parse(read_file(old / "plan" / "store.json"));
    store["transceiver_types"].begin().value()["cost"] = 3;
    write(store);
    EXPECT_THAT(told(fmt::format("plan @store.json --no-certificate --signal {} -o @{}",
                                 (old / "plan").string(), version)),
                HasSubstr("read from "))
        << version;
    EXPECT_EQ(signals(version).mean, read_signal_file(old / "plan" / "signal.h5").mean);
  }
}

}  // namespace
}  // namespace shelfbeam
