#include <fmt/ranges.h>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/report/data/outcome.hpp"
#include "shelfbeam/scene/store/store_parts.hpp"

#include "unit/report/shops.hpp"

namespace shelfbeam::test {
namespace {

// Nine significant digits are written: relative error below 5e-9.
bool same(const std::string& field, double value) {
  return std::abs(std::stod(field) - value) <= 5e-9 * std::abs(value);
}

void expect_same(const std::string& field, double value) {
  EXPECT_TRUE(same(field, value)) << field << " is not " << value;
}

TEST(LabelsCsv, AgreesWithThePlacement) {
  const Kiosk kiosk;
  const auto rows = read_csv(labels_csv(kiosk.input));
  ASSERT_EQ(rows.size(), kiosk.matrix.rows() + 1);
  EXPECT_EQ(
      fmt::format("{}", fmt::join(rows[0], ",")),
      "id,x,y,z,nx,ny,nz,type,requirement,signal,margin_db,direct_share,serving,strongest,error_trusted,"
      "description,fixture,face,board");
  const std::size_t n = kiosk.matrix.columns();
  for (std::size_t i = 0; i < kiosk.matrix.rows(); ++i) {
    const auto& row = rows[i + 1];
    ASSERT_EQ(row.size(), rows[0].size());
    const LabelRow& label = kiosk.matrix.labels[i];
    EXPECT_EQ(row[0], label.id);
    expect_same(row[1], label.position.x);
    expect_same(row[3], label.position.z);
    expect_same(row[5], label.normal.y);
    EXPECT_EQ(row[7], label.type);
    double signal = 0, direct = 0, largest = 0;
    std::string serving, strongest;
    for (const std::uint32_t j : kiosk.placement.selected) {
      const auto mean = static_cast<double>(kiosk.matrix.mean[i * n + j]);
      signal += mean;
      direct += static_cast<double>(kiosk.matrix.direct[i * n + j]);
      if (mean > largest) strongest = kiosk.matrix.transceivers[j].id;
      largest = std::max(largest, mean);
      if (mean >= label.requirement * (1 - 1e-9))
        serving += (serving.empty() ? "" : ";") + kiosk.matrix.transceivers[j].id;
    }
    expect_same(row[8], label.requirement);
    expect_same(row[9], signal);
    expect_same(row[10], 10 * std::log10(signal / label.requirement));
    expect_same(row[11], direct / signal);
    EXPECT_EQ(row[12], serving);
    EXPECT_EQ(row[13], strongest);
    EXPECT_EQ(row[14], "");
    // Negative control: a signal that is off by one part in 10^7 differs.
    EXPECT_FALSE(same(row[9], signal * (1 + 1e-7)));
  }
}

TEST(LabelsCsv, DocumentationNamesAllColumns) {
  const std::string page = read_file(SHELFBEAM_SOURCE_DIR "/docs/formats/report.md");
  const std::size_t begin = page.find("## labels.csv"), end = page.find("\n## ", begin);
  ASSERT_NE(end, std::string::npos);
  std::istringstream section(page.substr(begin, end - begin));
  std::vector<std::string> columns;
  for (std::string line; std::getline(section, line);) {
    if (!line.starts_with("| `")) continue;
    std::istringstream names(line.substr(2, line.find('|', 1) - 2));
    for (std::string name; std::getline(std::getline(names, name, '`'), name, '`');) columns.push_back(name);
  }
  ASSERT_FALSE(columns.empty());
  EXPECT_EQ(std::erase(columns, "availability"), 1U) << "only in plans for shops that change";
  EXPECT_EQ(columns, read_csv(labels_csv(Kiosk().input))[0]);
}

TEST(LabelsCsv, MarksLabelsThatDependOnFlaggedSignals) {
  Kiosk kiosk;
  kiosk.matrix.flags.assign(kiosk.matrix.mean.size(), 0);
  const auto untrusted = [&] {
    std::vector<std::size_t> labels;
    const auto rows = read_csv(labels_csv(kiosk.input));
    for (std::size_t i = 1; i < rows.size(); ++i) {
      EXPECT_TRUE(rows[i][14] == "yes" || rows[i][14] == "no") << rows[i][14];
      if (rows[i][14] == "no") labels.push_back(i - 1);
    }
    return labels;
  };
  EXPECT_TRUE(untrusted().empty());
  for (const std::uint32_t j : kiosk.placement.selected) kiosk.matrix.flags[kiosk.matrix.at(2, j)] = 1;
  EXPECT_EQ(untrusted(), (std::vector<std::size_t>{2}));
}

TEST(PlacementCsv, BeginsWithTheColumnsOfTheTransceiverCsv) {
  const Kiosk kiosk;
  const auto rows = read_csv(placement_csv(kiosk.input));
  const Outcome outcome = outcome_of(kiosk.matrix, kiosk.placement);
  EXPECT_EQ(rows[0], (std::vector<std::string>{"id", "x", "y", "z", "ax", "ay", "az", "roll_deg", "type",
                                               "cost", "installed", "reaches_alone", "strongest_for",
                                               "needed_by", "pinned", "place", "order_number"}));
  ASSERT_EQ(rows.size(), kiosk.placement.count() + 1);
  for (std::size_t k = 0; k < outcome.units.size(); ++k) {
    const UnitOutcome& unit = outcome.units[k];
    const Transceiver& transceiver = kiosk.scene.transceivers[unit.column];
    const auto& row = rows[k + 1];
    ASSERT_EQ(row.size(), rows[0].size());
    EXPECT_EQ(row[0], transceiver.id);
    expect_same(row[1], transceiver.position.x);
    expect_same(row[6], -1);
    expect_same(row[7], transceiver.roll_deg);
    EXPECT_EQ(row[10], transceiver.installed ? "1" : "0");
    EXPECT_EQ(row[11], std::to_string(unit.reaches_alone));
    EXPECT_EQ(row[12], std::to_string(unit.strongest_for));
    EXPECT_EQ(row[13], std::to_string(unit.needed_by));
  }
  const std::string text = placement_csv(kiosk.input);
  EXPECT_NE(text.find("\"T,2\""), std::string::npos);
}

TEST(Csv, BothFilesAreTablesThatAStoreCanName) {
  const Supermarket s;
  const TempFolder folder;
  folder.write("labels.csv", labels_csv(s.input));
  folder.write("placement.csv", placement_csv(s.input));
  const Scene again = make_scene(parse_store(R"({
    "name": "again", "room": { "size": [25, 18, 4], "floor": "grey", "ceiling": "grey", "walls": "grey" },
    "materials": { "grey": { "type": "lambertian", "reflectance": 0.7 } },
    "label_types": { "standard": { "responsivity": { "type": "cosine" }, "threshold": 0.01 },
                     "large": { "responsivity": { "type": "cosine" }, "threshold": 0.01 } },
    "transceiver_types": { "ceiling": { "emission": { "type": "sin2theta", "peak": 1 } } },
    "labels": { "csv": "labels.csv" }, "transceivers": { "list": { "csv": "placement.csv" } } })",
                                             "store.json", folder.path()));
  ASSERT_EQ(again.labels.size(), s.scene.labels.size());
  ASSERT_EQ(again.transceivers.size(), s.placement.count());
  for (std::size_t i = 0; i < s.scene.labels.size(); ++i) {
    EXPECT_EQ(again.labels[i].id, s.scene.labels[i].id);
    // Nine digits of lengths below 100 m: an error below 5e-8 m on each axis.
    EXPECT_LT(length(again.labels[i].position - s.scene.labels[i].position), 1e-7);
  }
  EXPECT_EQ(again.transceivers[0].id, s.matrix.transceivers[s.placement.selected[0]].id);
}

// Ids and types that are formulas, plain and safe.
TEST(LabelsCsv, RestoresHostileNames) {
  Store store = kiosk();
  const std::vector<std::string> ids{"=HYPERLINK(\"x\")", "'=1", "''@a", "-2,5;3", "'t Hofje"};
  store.label_types[0].name = "+type";
  store.labels.clear();
  for (std::size_t k = 0; k < ids.size(); ++k)
    add_label(store, ids[k], {0.5, 0.5 + 0.1 * static_cast<double>(k), 1}, {1, 0, 0});
  store.transceivers[0].value.id = "=T1";
  const PlannedShop s(store);
  for (const bool safe : {false, true}) {
    const ReportInput input{s.scene, s.matrix, s.plan, safe};
    const TempFolder folder;
    const auto labels = folder.write("labels.csv", labels_csv(input));
    const auto units = folder.write("placement.csv", placement_csv(input));
    Store again = store;
    again.labels.clear();
    again.transceivers.clear();
    read_labels_csv({InputFile(labels)}, StoreNames(again), again);
    read_transceivers_csv({InputFile(units)}, StoreNames(again), again);
    ASSERT_EQ(again.labels.size(), s.scene.labels.size());
    for (std::size_t i = 0; i < s.scene.labels.size(); ++i)
      EXPECT_EQ(again.labels[i].value.id, s.scene.labels[i].id);
    for (std::size_t k = 0; k < s.placement.selected.size(); ++k)
      EXPECT_EQ(again.transceivers[k].value.id, s.matrix.transceivers[s.placement.selected[k]].id);
    const auto rows = read_csv(read_file(labels));
    bool has_formula = false;
    for (const auto& row : rows)
      for (const std::size_t text : {0U, 7U, 12U, 13U})
        has_formula = has_formula || row[text].find_first_of("=+-@") == 0;
    EXPECT_EQ(has_formula, !safe);
    EXPECT_EQ(rows[1][10].find('\''), std::string::npos) << "a number";
  }
}

TEST(LabelsCsv, LeavesFieldsEmptyWithoutASelection) {
  Kiosk kiosk;
  kiosk.placement.selected.clear();
  kiosk.matrix.flags.assign(kiosk.matrix.mean.size(), 0);
  const auto rows = read_csv(labels_csv(kiosk.input));
  EXPECT_EQ(rows[1][9], "0");
  for (const std::size_t empty : {10U, 11U, 13U, 14U}) EXPECT_EQ(rows[1][empty], "") << empty;
  EXPECT_EQ(read_csv(placement_csv(kiosk.input)).size(), 1U);
}

TEST(BillCsv, CountsTheUnitsOfEachTypeAndPrice) {
  Kiosk kiosk;
  kiosk.placement.selected = {0, 1, 2};
  for (const std::uint32_t j : {0U, 1U, 2U}) kiosk.matrix.transceivers[j].installed = j == 0;
  for (const std::uint32_t j : {0U, 1U, 2U}) kiosk.matrix.transceivers[j].type = "wide";
  kiosk.matrix.transceivers[1].cost = kiosk.matrix.transceivers[0].cost = 80;
  kiosk.matrix.transceivers[2].cost = 95.5;
  kiosk.placement.price = Price{"EUR", 255.5, 175.5};
  EXPECT_EQ(bill_csv(kiosk.input),
            "type,order_number,to_buy,installed,price_each,price,currency\n"
            "wide,,1,1,80,80,EUR\n"
            "wide,,1,0,95.5,95.5,EUR\n");
  kiosk.placement.price->to_spend = 100;  // by other prices
  EXPECT_EQ(bill_csv(kiosk.input),
            "type,order_number,to_buy,installed,price_each,price,currency\n"
            "wide,,1,1,,,\n"
            "wide,,1,0,,,\n");
}

}  // namespace
}  // namespace shelfbeam::test
