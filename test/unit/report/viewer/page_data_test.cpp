// Tests the data of the 3-D view: shop, signals, verdicts, and the states of a shop that changes.

#include "shelfbeam/report/viewer/page_data.hpp"

#include <cstdlib>
#include <cstring>

#include <nlohmann/json.hpp>
#include <zlib.h>

#include "shelfbeam/report/data/shop_states.hpp"
#include "shelfbeam/report/page/sections.hpp"
#include "shelfbeam/report/viewer/page_signals.hpp"
#include "shelfbeam/scene/states/store_states.hpp"

#include "unit/report/shops.hpp"

namespace shelfbeam::test {
namespace {

std::string from_base64(std::string_view text) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::size_t bits = 0;
  for (unsigned count = 0; const char c : text.substr(0, text.find('='))) {
    if (digits.find(c) == digits.npos) throw std::runtime_error("not base64");
    bits = bits << 6U | digits.find(c);
    count = (count + 6) % 8;
    if (count < 6) bytes += static_cast<char>(bits >> count & 255U);
  }
  return bytes;
}

std::string inflated(const std::string& bytes) {
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) throw std::runtime_error("zlib");
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  std::string out;
  int status = Z_OK;
  while (status == Z_OK) {
    std::string piece(1 << 16, '\0');
    stream.next_out = reinterpret_cast<Bytef*>(piece.data());
    stream.avail_out = static_cast<uInt>(piece.size());
    status = inflate(&stream, Z_NO_FLUSH);
    out.append(piece, 0, piece.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  if (status != Z_STREAM_END) throw std::runtime_error("not deflated, or cut off");
  return out;
}

// Reads the data of a page, as its script does.
class PageReader {
 public:
  explicit PageReader(std::string_view base64) {
    const std::string all = inflated(from_base64(base64));
    std::uint32_t size = 0;
    std::memcpy(&size, all.data(), sizeof size);
    const auto header = nlohmann::json::parse(all.substr(4, size));
    about = header["about"];
    std::size_t at = 4 + size;
    for (const auto& array : header["arrays"]) {
      const std::string type = array["type"];
      const std::size_t width = type == "u8" ? 1 : type == "u16" ? 2 : type == "f64" ? 8 : 4;
      const std::size_t count = array["count"];
      std::string& bytes = arrays_[array["name"]];
      bytes.resize(width * count);
      for (std::size_t plane = 0; plane < width; ++plane)
        for (std::size_t k = 0; k < count; ++k) bytes[k * width + plane] = all.at(at++);
    }
    if (at != all.size()) throw std::runtime_error("arrays and bytes do not agree");
  }

  template <class Value>
  std::vector<Value> get(const std::string& name) const {
    const std::string& bytes = arrays_.at(name);
    std::vector<Value> values(bytes.size() / sizeof(Value));
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }

  nlohmann::json about;

 private:
  std::map<std::string, std::string> arrays_;
};

constexpr std::uint64_t states_seed = 5;

PageReader page_of(const ReportInput& input) {
  return PageReader(pack_store(ReportData(input), SignalScale({0.1, 1})));
}

TEST(PageData, IsReadBackUnchanged) {
  PageData page;
  const std::vector<std::uint8_t> bytes{0, 1, 255};
  const std::vector<std::uint16_t> words{0, 65535, 258};
  const std::vector<std::uint32_t> numbers{4294967295U, 66051};
  const std::vector<float> floats{0.1F, -1e-30F, INFINITY};
  const std::vector<double> doubles{0.1, -1e-300, 3};
  page.add("bytes", bytes);
  page.add("words", words);
  page.add("numbers", numbers);
  page.add("none", std::vector<float>());
  page.add("floats", floats);
  page.add("doubles", doubles);
  const std::string text = page.base64(R"({"name":"Käse & <b>"})");
  const PageReader reader(text);
  EXPECT_EQ(reader.about["name"], "Käse & <b>");
  EXPECT_EQ(reader.get<std::uint8_t>("bytes"), bytes);
  EXPECT_EQ(reader.get<std::uint16_t>("words"), words);
  EXPECT_EQ(reader.get<std::uint32_t>("numbers"), numbers);
  EXPECT_EQ(reader.get<float>("none"), std::vector<float>());
  EXPECT_EQ(reader.get<float>("floats"), floats);
  EXPECT_EQ(reader.get<double>("doubles"), doubles);
  // Negative control: the reader detects damage.
  std::string damaged = text;
  damaged[damaged.size() / 2] = damaged[damaged.size() / 2] == 'A' ? 'B' : 'A';
  EXPECT_ANY_THROW(PageReader{damaged});
  EXPECT_ANY_THROW(PageReader{text.substr(0, text.size() - 8)});
}

TEST(PageRoom, HasTheSurfacesOfTheRoom) {
  const PageReader page = page_of(PlannedShop(corner_shop()).input);
  const auto vertex = page.get<float>("room_vertex");
  const auto triangle = page.get<std::uint32_t>("room_triangle");
  const auto surface = page.get<std::uint8_t>("room_surface");
  ASSERT_EQ(triangle.size(), 3 * surface.size());
  std::map<int, double> area, upward;
  double outward = 0;
  const auto corner = [&](std::size_t k) {
    const std::size_t at = std::size_t{3} * triangle[k];
    return Vec3{static_cast<double>(vertex[at]), static_cast<double>(vertex[at + 1]),
                static_cast<double>(vertex[at + 2])};
  };
  for (std::size_t t = 0; t < surface.size(); ++t) {
    const Vec3 a = corner(3 * t), b = corner(3 * t + 1), c = corner(3 * t + 2);
    const Vec3 normal = cross(b - a, c - a) / 2;
    area[surface[t]] += length(normal);
    upward[surface[t]] += normal.z;
    if (surface[t] == 1) outward += dot(normal, a) / 3;
  }
  const double floor = 12 * 10 - 4 * 4 / 2.0 - 1;
  const double walls = 0.2 * 2.9 + 0.2 * 5;  // in plan, with the corner of both once
  EXPECT_NEAR(area[0], floor - walls + 0.2 * 0.9, 0.05) << "also in the door";
  EXPECT_NEAR(upward[0], area[0], 1e-3);
  EXPECT_NEAR(area[3], 0.8 * 1.1, 1e-4) << "the pane";
  EXPECT_GT(area[2], 2 * 2.0 * 3.2 / 2) << "inner walls";
  // The shell faces away from the room: from the origin, walls and ceilings enclose a positive volume, which
  // is that of the room because the floor is at the height of the origin.
  EXPECT_NEAR(outward, 3.2 * (floor - 16 - 0.2 * 2.9) + 2.6 * 16, 2.5);
  std::vector<std::string> names;
  for (const auto& fixture : page.about["fixtures"]) names.push_back(fixture["id"]);
  EXPECT_EQ(names, (std::vector<std::string>{"row", "counter", "column", "screen", "W1", "W2", "bakery"}));
}

// The page of a plain box keeps its bytes.
TEST(PageRoom, IsOmittedForABox) {
  EXPECT_ANY_THROW(page_of(Kiosk().input).get<float>("room_vertex"));
}

TEST(PageStore, NamesTheContentsOfTheReport) {
  const Supermarket s;
  const ReportData data(s.input);
  const PageReader page = page_of(s.input);
  const auto& about = page.about;
  ASSERT_EQ(about["labels"]["ids"].size(), s.matrix.rows());
  ASSERT_EQ(about["units"]["ids"].size(), s.matrix.columns());
  std::vector<std::uint32_t> selected;
  for (const UnitOutcome& unit : data.outcome.units) selected.push_back(unit.column);
  EXPECT_EQ(about["units"]["selected"], selected);
  EXPECT_EQ(about["levels"].size(), data.levels.size());
  EXPECT_EQ(about["unit"]["name"], data.unit.name);
  const auto kind = page.get<std::uint16_t>("label_kind"), level = page.get<std::uint16_t>("label_level");
  const auto position = page.get<float>("label_position");
  for (std::size_t i = 0; i < s.matrix.rows(); ++i) {
    const LabelRow& label = s.matrix.labels[i];
    EXPECT_EQ(about["labels"]["ids"][i], label.id);
    EXPECT_EQ(about["labels"]["kinds"][kind[i]]["requirement"].get<double>(), label.requirement);
    EXPECT_EQ(about["labels"]["kinds"][kind[i]]["type"], label.type);
    EXPECT_EQ(position[3 * i + 2], static_cast<float>(label.position.z));
    EXPECT_GE(label.position.z, data.levels[level[i]].low);
    EXPECT_LE(label.position.z, data.levels[level[i]].high);
  }
  EXPECT_EQ(about["labels"]["kinds"].size(), 2U);
  const auto corners = page.get<std::uint8_t>("part_corners");
  std::size_t all = 0;
  for (const std::uint8_t count : corners) all += count;
  EXPECT_EQ(page.get<float>("part_outline").size(), 2 * all);
  EXPECT_EQ(page.get<float>("part_height").size(), 2 * corners.size());
}

TEST(PageStore, HasTheVerdictsOfACertificate) {
  Kiosk s;
  const PageReader without = page_of(s.input);
  EXPECT_TRUE(without.about["certificate"].is_null());
  EXPECT_THAT(without.get<std::uint8_t>("label_verdict"), testing::IsEmpty());
  certify(s);
  const PageReader page = page_of(s.input);
  EXPECT_EQ(page.about["certificate"]["confidence"], 0.95);
  const auto verdicts = page.get<std::uint8_t>("label_verdict");
  ASSERT_EQ(verdicts.size(), s.matrix.rows());
  for (std::size_t i = 0; i < verdicts.size(); ++i)
    EXPECT_EQ(verdicts[i], static_cast<std::uint8_t>(s.plan.certificate->labels[i].verdict));
}

TEST(ViewerSection, HasItsData) {
  const Kiosk s;
  const std::string section = viewer_section(ReportData(s.input), "let script;");
  EXPECT_EQ(section.find("3-D view is missing"), std::string::npos);
  EXPECT_THAT(missing_in(section, {"exact signals of signal.h5", "<script>let script;</script>"}),
              testing::IsEmpty());
}

TEST(ViewerSection, StatesThatABuildWithoutNodeOmitsIt) {
  const Kiosk s;
  const Page section(viewer_section(ReportData(s.input), ""));
  EXPECT_TRUE(section.has_text("made without Node.js or its packages"));
  for (const char* part : {"<script", "viewer-root"}) EXPECT_FALSE(section.has(part)) << part;
}

TEST(ViewerSection, OfThisBuildIsSelfContained) {
  const Supermarket s;
  EXPECT_LT(report_html(s.input).size(), 10'000'000U);
  if (viewer_script().empty()) {
    if (SHELFBEAM_VIEWER_WANTED != 0 && std::getenv("CI") != nullptr)
      FAIL() << "continuous integration lacks Node.js or its packages";
    GTEST_SKIP() << "this build has no 3-D view: Node.js or its packages were missing";
  }
  // The data do not end the script early.
  const std::string section = viewer_section(ReportData(s.input), viewer_script());
  EXPECT_EQ(count_of("</script", section), 4U);
  EXPECT_EQ(section.find("<!--"), std::string::npos);
}

// Three people, a pallet, and doors that are always open at one fixture and always closed at the other.
Store changing_store() {
  Store store = empty_store("Kiosk", {8, 6, 3});
  store.materials.push_back({"glass", ThinDielectric{}});
  for (const double y : {1.5, 4.0}) {
    Gondola fridge = gondola(y < 2 ? "G1" : "G2", {2, y}, 3, 0.6, {0.5, 1.2}, 0, {Face::front});
    fridge.doors = MaterialId{1};
    fridge.variation.open = y < 2 ? 0 : 1;
    add(store, fridge);
  }
  add_devices(store, {7.9, 3, 1}, {4, 3, 2.9});
  const PlanArea area{std::string("room")};
  StoreVariation& variation = store.variation.emplace();
  variation.boxes.push_back({"person", area, UniformNumber{3, 3}, {0.5, 0.3, 1.75}, MaterialId{0}, true});
  variation.boxes.push_back({"pallet", area, Presence{1}, {1.2, 0.8, 1.4}, MaterialId{0}, false});
  return store;
}

struct ChangingShop : PlannedShop {
  ChangingShop() : PlannedShop(changing_store()) {
    matrix.provenance.seed = states_seed;
    plan.availability.emplace().shown = {{1'000'000, {}}, {1'000'217, {0, 3}}};
  }
  ReportInput with_states() const {
    return {scene, matrix, plan, false, shop_states(store, scene, matrix, plan)};
  }
};

std::string packed(const ReportInput& input) {
  return pack_store(ReportData(input), SignalScale({0.1, 1}));
}

TEST(PageStates, HavePeopleObjectsAndDoorsOfTheirScenes) {
  const ChangingShop shop;
  const ReportInput input = shop.with_states();
  const PageReader page = page_of(input);
  const auto outline = page.get<float>("block_outline"), height = page.get<float>("block_height");
  const StoreStates states(shop.store, shop.scene, states_seed);
  std::size_t block = 0, equal_states = 0;
  ASSERT_EQ(page.about["states"].size(), 2U);
  for (const auto& state : page.about["states"]) {
    const Scene drawn = make_scene(states.state(state["number"]));
    ASSERT_EQ(state["blocks"], 4U);
    std::size_t boxes = 0;
    for (const Part& expected : drawn.parts) {
      if (expected.fixture < shop.scene.fixtures.size()) continue;
      for (std::size_t at = 0; at < 8; ++at)
        EXPECT_FLOAT_EQ(outline.at(8 * block + at),
                        static_cast<float>(expected.footprint.at(at / 2)[at % 2]));
      EXPECT_EQ(height.at(2 * block), 0);
      EXPECT_FLOAT_EQ(height.at(2 * block + 1), static_cast<float>(expected.top));
      ++block;
      ++boxes;
    }
    EXPECT_EQ(boxes, 4U);
    EXPECT_EQ(state["open"], std::vector<int>{1});
    equal_states += outline.at(0) == outline.at(8 * block - 32) ? 1 : 0;
  }
  EXPECT_EQ(equal_states, 1U) << "the states differ";
  EXPECT_EQ(8 * block, outline.size());
  EXPECT_EQ(page.about["states"][0]["missed"], std::vector<int>());
  EXPECT_EQ(page.about["states"][1]["missed"], (std::vector<int>{0, 3}));
  std::size_t doors = 0;
  for (const std::uint8_t look : page.get<std::uint8_t>("part_look")) doors += look == 3 ? 1 : 0;
  const auto fixtures = page.get<std::uint32_t>("door_fixture");
  ASSERT_EQ(fixtures.size(), doors);
  EXPECT_EQ(fixtures.front(), 0U);
  EXPECT_EQ(fixtures.back(), 1U);
}

// 'report' reads the resolved store from the folder of the plan.
TEST(PageStates, AreTheSameFromTheResolvedStore) {
  const ChangingShop shop;
  const TempFolder folder;
  const Store store = read_store(folder.write("store.json", resolved_store_json(shop.store, shop.scene)));
  const Scene scene = make_scene(store);
  const ReportInput again{scene, shop.matrix, shop.plan, false,
                          shop_states(store, scene, shop.matrix, shop.plan)};
  EXPECT_EQ(packed(again), packed(shop.with_states()));
}

// Reused signals may have another seed than the plan.
TEST(PageStates, HaveTheSeedOfThePlan) {
  ChangingShop shop;
  const std::string page = packed(shop.with_states());
  shop.matrix.provenance.seed = states_seed + 1;
  EXPECT_NE(packed(shop.with_states()), page) << "without a seed of the plan";
  shop.plan.seed = states_seed;
  EXPECT_EQ(packed(shop.with_states()), page);
}

TEST(PageStates, AreOmittedForAShopThatDoesNotChange) {
  ChangingShop shop;
  shop.plan.availability.reset();
  EXPECT_TRUE(shop.with_states().states.empty());
  EXPECT_FALSE(PageReader(packed(shop.with_states())).about.contains("states"));
  EXPECT_ANY_THROW(PageReader(packed(shop.with_states())).get<float>("block_outline"));
}

constexpr auto adds_up = CommunicationModel::cooperative, alone = CommunicationModel::non_cooperative;

double received(const std::vector<double>& row, const std::vector<bool>& chosen,
                const PlacementProblem& problem) {
  std::vector<SignalEntry> entries;
  for (std::uint32_t j = 0; j < row.size(); ++j) entries.push_back({j, row[j]});
  return received_signal(entries, chosen, problem);
}

// A plan with its signals on a page, and these as a dense matrix with 0 for omitted entries.
struct Rounded {
  const SignalMatrix& matrix;
  Placement placement;
  PageSignals signals;
  std::vector<float> mean;
  std::vector<double> error, direct;  // direct is a share of the mean
  std::vector<bool> chosen;

  Rounded(const SignalMatrix& of, Selection selected, const Rounding& rounding,
          const PlacementProblem& problem = {.model = adds_up})
      : matrix(of),
        mean(of.mean.size()),
        error(of.mean.size()),
        direct(of.mean.size()),
        chosen(of.columns()) {
    placement.problem = problem;
    placement.selected = std::move(selected);
    placement.status = Status::feasible;
    signals = page_signals(matrix, placement, rounding);
    for (const std::uint32_t j : placement.selected) chosen[j] = true;
    for (std::size_t i = 0, at = 0; i < signals.row_size.size(); ++i) {
      std::size_t column = 0;
      for (std::uint32_t k = 0; k < signals.row_size[i]; ++k, ++at, ++column) {
        column += signals.gap[at];
        const std::size_t place = matrix.at(i, column);
        mean.at(place) = signals.mean[at];
        if (!signals.error.empty() && signals.error[at] > 0)
          error[place] = signals.min_error * std::exp((signals.error[at] - 1) * signals.error_step) *
                         (signals.grain > 0 ? std::abs(static_cast<double>(signals.mean[at])) : 1);
        if (!signals.direct.empty()) direct[place] = signals.direct[at] * signals.direct_step;
      }
    }
  }

  double requirement(std::size_t label) const { return matrix.labels[label].requirement; }
  double shown(std::size_t label) const {
    const auto begin = mean.begin() + static_cast<std::ptrdiff_t>(matrix.at(label, 0));
    return received({begin, begin + static_cast<std::ptrdiff_t>(matrix.columns())}, chosen,
                    placement.problem);
  }
  double truth(std::size_t label) const {
    std::vector<double> row;
    for (std::size_t j = 0; j < matrix.columns(); ++j) row.push_back(matrix.signal(label, j));
    return received(row, chosen, placement.problem);
  }
  // Error and direct share of an entry are those of the matrix, but for a step.
  void expect_details(std::size_t at, double direct_step) const {
    const auto of_matrix = static_cast<double>(matrix.standard_error[at]);
    EXPECT_NEAR(error[at], of_matrix, 1.0001 * std::expm1(0.5 * signals.error_step) * of_matrix);
    EXPECT_NEAR(direct[at], static_cast<double>(matrix.direct[at]) / static_cast<double>(matrix.mean[at]),
                0.5001 * direct_step);
  }
};

TEST(PageSignals, AreTheMatrixIfItFits) {
  const SignalMatrix matrix = random_matrix(60, 40, 1);
  const Rounded all(matrix, {3, 8, 20}, {});
  EXPECT_EQ(all.mean, matrix.mean);
  EXPECT_EQ(all.signals.omitted, 0U);
  EXPECT_EQ(all.signals.largest_effect, 0);
  EXPECT_TRUE(all.signals.rest.empty());
  EXPECT_LT(std::expm1(0.5 * all.signals.error_step), 3e-4);
  for (std::size_t k = 0; k < matrix.mean.size(); ++k)
    if (matrix.mean[k] != 0) all.expect_details(k, 1.0 / 65535);
}

TEST(PageSignals, AreRoundedToAShareOfTheRequirement) {
  SignalMatrix matrix = random_matrix(80, 50, 2);
  for (std::size_t at = 5; at < matrix.mean.size(); at += 97) {
    matrix.mean[at] *= -1;  // which noise of a control variate may cause
    matrix.direct[at] = 0;
  }
  for (const std::uint32_t fineness : {200U, 20U, 3U}) {
    const Rounded rounded(matrix, {1, 7, 30}, {fineness, 0, 1.2, 0.01});
    const double grain = 1.0 / fineness;
    std::size_t omitted = 0, crossing = 0;
    double largest = 0, effect = 0;
    for (std::size_t i = 0; i < matrix.rows(); ++i) {
      const double need = rounded.requirement(i);
      double of_label = 0;
      for (std::size_t j = 0; j < matrix.columns(); ++j) {
        const std::size_t at = matrix.at(i, j);
        const double mean = matrix.signal(i, j);
        const auto shown = static_cast<double>(rounded.mean[at]);
        const double off = std::abs(mean - shown) / need;
        // Units that reach a label alone still do, and no others.
        EXPECT_EQ(is_met(shown, need), is_met(mean, need)) << i << " " << j;
        if (is_met(std::round(mean / need * fineness) * grain * need, need) != is_met(mean, need)) ++crossing;
        of_label += off;
        largest = std::max(largest, off);
        if (mean != 0 && shown == 0) {
          ++omitted;
          EXPECT_LT(mean / need, grain);
          continue;
        }
        EXPECT_LE(off, 0.5 * grain * (1 + 1e-5));
        if (mean != 0) rounded.expect_details(at, rounded.signals.direct_step);
      }
      effect = std::max(effect, of_label);
    }
    EXPECT_EQ(rounded.signals.omitted, omitted);
    EXPECT_GT(omitted, 0U);
    EXPECT_DOUBLE_EQ(rounded.signals.largest_error, largest);
    EXPECT_DOUBLE_EQ(rounded.signals.largest_effect, effect);
    // Negative control: rounding to the nearest grain would move some across their label's requirement.
    EXPECT_GT(crossing, 0U);
  }
}

TEST(PageSignals, KeepDetailsOfStrongSignals) {
  const SignalMatrix matrix = random_matrix(40, 30, 7);
  const Rounded rounded(matrix, {2, 5}, {50, 0.3, 1.5, 0.05});
  std::size_t detailed = 0, others = 0;
  for (std::size_t at = 0; at < matrix.mean.size(); ++at) {
    if (rounded.mean[at] == 0) continue;
    if (static_cast<double>(matrix.mean[at]) < 0.3 * rounded.requirement(at / matrix.columns())) {
      ++others;
      EXPECT_EQ(rounded.error[at], 0);
    } else {
      ++detailed;
      rounded.expect_details(at, 0.05);
    }
  }
  EXPECT_GT(detailed, 100U);
  EXPECT_GT(others, 100U);
}

TEST(PageSignals, SwitchErrorsStayWithinTheStatedBound) {
  const SignalMatrix matrix = random_matrix(60, 40, 5);
  for (const auto model : {adds_up, alone})
    for (const bool redundant : {false, true}) {
      Rounded page(matrix, {0, 4, 9, 17, 25, 31, 38}, {10, 0, 1.2, 0.01},
                   {.model = model, .redundant = redundant});
      const double largest = page.signals.largest_error;
      double worst = 0, without_rest = 0;
      for (std::uint32_t switches = 1; switches <= matrix.columns(); ++switches) {
        const std::uint32_t unit = switches * 7 % 40;
        page.chosen[unit] = !page.chosen[unit];
        const double allowed = largest * (model == adds_up ? switches + (redundant ? 2 : 0) : 1) * (1 + 1e-9);
        for (std::size_t i = 0; i < matrix.rows(); ++i) {
          const double need = page.requirement(i), shown = page.shown(i), truth = page.truth(i);
          const double off = std::abs(shown + (model == adds_up ? page.signals.rest[i] : 0) - truth) / need;
          EXPECT_LE(off, allowed) << i << " " << switches;
          EXPECT_LE(off, page.signals.largest_effect + (redundant && model == adds_up ? 2 * largest : 1e-9));
          if (switches > 1) continue;
          worst = std::max(worst, off);
          without_rest = std::max(without_rest, std::abs(shown - truth) / need);
        }
      }
      // Negative control: without the rounding errors of the plan's entries, one switch would exceed the
      // stated error.
      EXPECT_TRUE(without_rest > largest || model == alone || redundant);
      EXPECT_GT(worst, 0);
    }
}

TEST(PageSignals, CountThePlanAsItsFilesDo) {
  const SignalMatrix matrix = random_matrix(70, 40, 3);
  for (const auto model : {adds_up, alone})
    for (const bool redundant : {false, true})
      for (const Rounding& rounding : {Rounding{}, Rounding{5, 0, 1.2, 0.01}}) {
        const Rounded page(matrix, {0, 4, 9, 17, 25, 31, 38}, rounding,
                           {.model = model, .redundant = redundant});
        const Outcome outcome = outcome_of(matrix, page.placement);
        std::size_t met = 0, without_rest = 0;
        for (std::size_t i = 0; i < matrix.rows(); ++i) {
          const double signal = page.shown(i) + (page.signals.rest.empty() ? 0 : page.signals.rest[i]);
          EXPECT_DOUBLE_EQ(signal, outcome.labels[i].signal) << i;
          met += is_met(signal, page.requirement(i)) ? 1 : 0;
          without_rest += page.shown(i) == outcome.labels[i].signal ? 1 : 0;
        }
        EXPECT_EQ(met, outcome.met);
        // Negative control: the rounding error is visible if it is not added again.
        EXPECT_TRUE(without_rest < matrix.rows() || rounding.grains_per_requirement == 0);
      }
}

TEST(PageSignals, StayWithinTheirBytes) {
  const Supermarket s;
  const PackedSignals all = pack_signals(s.matrix, s.placement, 100'000'000);
  EXPECT_EQ(all.signals.grain, 0);
  double coarser = 0;
  for (const std::size_t bytes : {all.base64.size() / 3, all.base64.size() / 8, all.base64.size() / 20}) {
    const PackedSignals packed = pack_signals(s.matrix, s.placement, bytes);
    const PageSignals& signals = packed.signals;
    EXPECT_LE(packed.base64.size(), bytes);
    EXPECT_GT(packed.base64.size(), bytes * 6 / 10) << "a finer grain would fit";
    EXPECT_GT(signals.grain, coarser);
    coarser = signals.grain;
    const PageReader reader(packed.base64);
    EXPECT_EQ(reader.about["grain"], signals.grain);
    EXPECT_EQ(reader.get<double>("rest"), signals.rest);
    // As the page's script reads them.
    const auto grains = reader.get<std::uint32_t>("grains");
    ASSERT_EQ(grains.size(), signals.mean.size());
    for (std::size_t i = 0, at = 0; i < s.matrix.rows(); ++i)
      for (std::uint32_t k = 0; k < signals.row_size[i]; ++k, ++at)
        ASSERT_EQ(static_cast<float>((grains[at] + 0.5) * signals.grain * s.matrix.labels[i].requirement),
                  signals.mean[at]);
  }
  EXPECT_EQ(pack_signals(s.matrix, s.placement, all.base64.size()).signals.grain, 0);
  // Required entries are kept even without any memory.
  const PackedSignals least = pack_signals(s.matrix, s.placement, 1);
  EXPECT_EQ(least.signals.grain, 1);
  EXPECT_GT(least.signals.mean.size(), s.matrix.rows());
  EXPECT_LE(least.signals.largest_error, 1);
}

TEST(PageSignals, NeedNeitherErrorsNorDirectPart) {
  SignalMatrix matrix = random_matrix(10, 10, 4);
  matrix.standard_error.clear();
  matrix.direct.clear();
  EXPECT_EQ(Rounded(matrix, {}, {}).mean, matrix.mean);
  for (const Rounding& rounding : {Rounding{}, Rounding{100, 0.3, 1.5, 0.05}}) {
    const Rounded page(matrix, {}, rounding);
    EXPECT_TRUE(page.signals.error.empty() && page.signals.direct.empty());
  }
}

TEST(PageSignals, LabelsWithoutRequirementAreRoundedAsOthers) {
  SignalMatrix matrix = random_matrix(10, 10, 6);
  matrix.labels[3].requirement = 0;
  const Rounded page(matrix, {}, {100, 0, 1.2, 0.01});
  double most = 0;
  for (const LabelRow& label : matrix.labels) most = std::max(most, label.requirement);
  for (std::size_t j = 0; j < 10; ++j)
    EXPECT_NEAR(page.mean[matrix.at(3, j)], matrix.mean[matrix.at(3, j)], 0.01 * most);
}

}  // namespace
}  // namespace shelfbeam::test
