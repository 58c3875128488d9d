#include "shelfbeam/plan/question/fitting_signals.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/scene/light_keys.hpp"
#include "shelfbeam/transport/run/matrix_rows.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

#include "physics/bare_scene.hpp"
#include "unit/scene/sample_store.hpp"

namespace shelfbeam {
namespace {

using test::Json;

constexpr auto by_reuse = "reuse, 128 + 3 first rays per batch";

std::variant<SignalMatrix, MisfitReason> fit(StoredSignals signals, const Scene& scene,
                                             const PathRules& wanted = SimulationOptions().rules()) {
  return fitting_signals(std::move(signals), scene, wanted);
}

// Every entry has another value.
StoredSignals signals_of(const Scene& scene) {
  StoredSignals signals{detail::matrix_head(scene, scene_hash(scene), 7, by_reuse)};
  const std::size_t size = signals.rows() * signals.columns();
  for (std::size_t k = 0; k < size; ++k) {
    signals.mean.push_back(static_cast<float>(k));
    signals.standard_error.push_back(static_cast<float>(k) + 0.25F);
    signals.direct.push_back(static_cast<float>(k) + 0.5F);
    signals.flags.push_back(k % 3 == 0 ? 1 : 0);
  }
  for (std::size_t i = 0; i < signals.rows(); ++i) signals.labels[i].samples = i;
  return signals;
}

struct Change {
  std::optional<Misfit> misfit;  ///< nothing: the signals still fit
  std::function<void(Json& store, double x)> apply;
};

Change sets(const std::string& pointer, double from, double to, std::optional<Misfit> misfit = {}) {
  return {misfit,
          [=](Json& store, double x) { store[Json::json_pointer(pointer)] = from + x * (to - from); }};
}

std::string name_of(double x) {
  return "X" + std::to_string(static_cast<int>(1e6 * x));
}

// `x` is in (0, 1). No change reverses another.
const std::vector<Change>& changes() {
  static const std::vector<Change> all{
      sets("/transceiver_types/down/cost", 5, 9),
      sets("/label_types/small/threshold", 0.03, 0.09),
      sets("/label_types/small/safety_factor", 2, 4),
      sets("/label_types/large/link_cost", 1, 2),
      sets("/label_types/deep/responsivity/exponent", 3, 4),  // no label has this type
      sets("/materials/carton/reflectance", 0.1, 0.5),        // nor a surface this material
      {{}, [](Json& store, double x) { store["name"] = name_of(x); }},
      {{}, [](Json& store, double x) { store["fixtures"][1]["id"] = name_of(x); }},
      {{}, [](Json& store, double) { store["labels"] = Json::array(); }},
      {{},
       [](Json& store, double x) {
         for (Json& label : store["labels"]) label["relative_sensitivity"] = 1 + x;
       }},
      {{}, [](Json& store, double) { store["transceivers"]["installed"] = Json::array(); }},
      {{}, [](Json& store, double) { store["transceivers"]["keep_out"][0]["max"] = {3.5, 3.5}; }},
      {{},
       [](Json& store, double x) {
         Json reordered{{name_of(x), {{"type", "lambertian"}, {"reflectance", x}}}};
         reordered.update(store["materials"]);
         store["materials"] = reordered;
       }},
      sets("/wavelength_nm", 945, 949, Misfit::light),
      sets("/materials/white/reflectance", 0.1, 0.7, Misfit::light),
      sets("/materials/foil/eta", 1, 1.5, std::nullopt),
      sets("/fixtures/1/at/0", 1.1, 1.9, Misfit::light),
      sets("/fixtures/2/max/2", 1, 2.9, Misfit::light),
      sets("/fixtures/0/stocking", 0.1, 0.5, Misfit::light),
      {Misfit::light, [](Json& store, double) { store["fixtures"][1]["goods"] = "carton"; }},
      sets("/fixtures/0/labels/tilt_deg", 11, 40, Misfit::labels),
      sets("/label_types/small/responsivity/exponent", 2, 4, Misfit::labels),
      sets("/label_types/large/size/0", 0.1, 0.2, Misfit::labels),
      {Misfit::labels,
       [](Json& store, double x) {
         store["labels"].push_back(
             {{"id", name_of(x)}, {"position", {4 + x, 2, 1}}, {"normal", {0, 1, 0}}, {"type", "large"}});
       }},
      sets("/transceiver_types/down/emission/peak", 2.5, 4, Misfit::transceivers),
      sets("/transceiver_types/ring/radius", 0.05, 0.1, Misfit::transceivers),
      sets("/transceivers/grids/0/z", 2.5, 2.85, Misfit::transceivers),
      sets("/transceivers/list/0/roll_deg", 40, 80, Misfit::transceivers),
      sets("/transceivers/list/0/axis/0", 0.1, 0.9, Misfit::transceivers),
      {Misfit::transceivers,
       [](Json& store, double x) {
         store["transceivers"]["list"].push_back(
             {{"id", name_of(x)}, {"position", {4 + x, 3, 2.5}}, {"type", "wide"}});
       }},
  };
  return all;
}

Json sample() {
  Json store = test::sample_store();
  store["label_types"]["small"]["responsivity"] = {{"type", "cosine_power"}, {"exponent", 1}};
  store["label_types"]["large"]["size"] = {0.05, 0.05};
  return store;
}

template <class Row>
auto place_of(const Row& row) {
  const Vec3& p = row.position;
  if constexpr (requires { row.normal; })
    return std::tuple(p.x, p.y, p.z, row.normal.x, row.normal.y, row.normal.z);
  else
    return std::tuple(p.x, p.y, p.z, row.axis.x, row.axis.y, row.axis.z);
}

template <class Row>
std::size_t index_at(const std::vector<Row>& rows, const Row& place) {
  const auto found =
      std::ranges::find_if(rows, [&](const Row& row) { return place_of(row) == place_of(place); });
  return static_cast<std::size_t>(found - rows.begin());
}

template <class Rows>
std::vector<std::string> ids_of(const Rows& rows) {
  std::vector<std::string> ids;
  ids.reserve(rows.size());
  for (const auto& row : rows) ids.push_back(row.id);
  return ids;
}

void expect_same_entries(const SignalMatrix& fitting, const StoredSignals& all, const Scene& scene) {
  ASSERT_EQ(fitting.rows(), scene.labels.size());
  ASSERT_EQ(fitting.columns(), scene.transceivers.size());
  EXPECT_EQ(fitting.provenance.store_hash, scene.store_hash);
  for (std::size_t i = 0; i < fitting.rows(); ++i) {
    const LabelRow& row = fitting.labels[i];
    ASSERT_EQ(row.id, scene.labels[i].id);
    ASSERT_EQ(row.requirement, scene.requirement_of(scene.labels[i]));
    const std::size_t k = index_at(all.labels, row);
    ASSERT_EQ(row.samples, all.labels.at(k).samples);
    for (std::size_t j = 0; j < fitting.columns(); ++j) {
      const TransceiverColumn& column = fitting.transceivers[j];
      ASSERT_EQ(column.cost, scene.type_of(scene.transceivers[j]).cost);
      ASSERT_EQ(column.installed, scene.transceivers[j].installed);
      const std::size_t from = all.at(k, index_at(all.transceivers, column)), to = fitting.at(i, j);
      ASSERT_EQ(fitting.mean[to], all.mean.at(from));
      ASSERT_EQ(fitting.standard_error[to], all.standard_error[from]);
      ASSERT_EQ(fitting.direct[to], all.direct[from]);
      ASSERT_EQ(fitting.flags[to], all.flags[from]);
    }
  }
}

TEST(FittingSignals, AreThoseOfAStoreWithTheSameLight) {
  const Scene scene = test::scene_of(sample());
  const StoredSignals all = signals_of(scene);
  std::mt19937 random(50);
  std::uniform_real_distribution<double> inside(0.05, 0.95);
  std::map<std::size_t, int> times;
  int fitting_with_other_names = 0, misfits_with_the_same_names = 0;
  for (int k = 0; k < 300; ++k) {
    Json store = sample();
    std::optional<Misfit> expected;
    const int length = 1 + k % 6;
    for (int c = 0; c < length; ++c) {
      // Most sequences would not fit otherwise.
      std::size_t which = random() % changes().size();
      if (k % 2 == 0)
        while (changes()[which].misfit) which = random() % changes().size();
      const Change& change = changes()[which];
      change.apply(store, inside(random));
      if (change.misfit && (!expected || *change.misfit < *expected)) expected = change.misfit;
      ++times[which];
    }
    const Scene changed = test::scene_of(store);
    const auto found = fit(all, changed);
    const bool has_same_names = ids_of(changed.labels) == ids_of(scene.labels) &&
                                ids_of(changed.transceivers) == ids_of(scene.transceivers);
    if (expected) {
      ASSERT_TRUE(std::holds_alternative<MisfitReason>(found)) << store.dump(1);
      EXPECT_EQ(std::get<MisfitReason>(found).code, *expected) << store.dump(1);
      misfits_with_the_same_names += has_same_names ? 1 : 0;
    } else {
      ASSERT_TRUE(std::holds_alternative<SignalMatrix>(found))
          << to_text(std::get<MisfitReason>(found).code) << store.dump(1);
      expect_same_entries(std::get<SignalMatrix>(found), all, changed);
      fitting_with_other_names += has_same_names ? 0 : 1;
    }
  }
  EXPECT_EQ(times.size(), changes().size()) << "each change was made";
  // A comparison by names would have failed both ways.
  EXPECT_GT(misfits_with_the_same_names, 30);
  EXPECT_GT(fitting_with_other_names, 30);
}

TEST(FittingSignals, KeepTheirBytesForTheSameLabelsAndCandidates) {
  Json store = sample();
  const StoredSignals all = signals_of(test::scene_of(store));
  store["label_types"]["large"]["safety_factor"] = 3;
  const Scene changed = test::scene_of(store);
  const auto found = fit(all, changed);
  const auto& fitting = std::get<SignalMatrix>(found);
  EXPECT_EQ(fitting.mean, all.mean);
  EXPECT_EQ(fitting.standard_error, all.standard_error);
  EXPECT_EQ(fitting.provenance.seed, 7u);
}

Misfit misfit_of(const StoredSignals& signals, const Scene& scene,
                 const PathRules& wanted = SimulationOptions().rules()) {
  const auto found = fit(signals, scene, wanted);
  const auto* reason = std::get_if<MisfitReason>(&found);
  return reason != nullptr ? reason->code : throw std::runtime_error("they fit");
}

StoredSignals without_light(StoredSignals signals) {
  signals.provenance.light_hash.reset();
  for (LabelRow& row : signals.labels) row.light = 0;
  for (TransceiverColumn& column : signals.transceivers) column.light = 0;
  return signals;
}

TEST(FittingSignals, OfOlderFilesAreThoseOfTheirStore) {
  const Json store = sample();
  const Scene scene = test::scene_of(store);
  const StoredSignals all = signals_of(scene), old = without_light(all);
  const auto found = fit(old, scene);
  EXPECT_EQ(std::get<SignalMatrix>(found), static_cast<const SignalMatrix&>(all)) << "with the keys of light";
  Json cheaper = store;
  cheaper["transceiver_types"]["down"]["cost"] = 1;
  EXPECT_EQ(misfit_of(old, test::scene_of(cheaper)), Misfit::store);
}

// A ball of smooth plastic, whose coat older programs kept smooth: by the file without light_hash, or by the
// light_hash of the store as it is.
TEST(FittingSignals, OfOlderFilesOmitLightOverSmoothCoatsOfCurvedMeshes) {
  test::BareScene room;
  room.box(room.material(Lambertian{0.5}), {-3, -3, -3}, {6, 6, 6});
  room.label({0, 0, -2.9}, {0, 0, 1});
  room.unit({0, 0, 2.9}, {0, 0, -1}, SinTwoTheta{1});
  const Material smooth = make_plastic(1.5, 0.8),
                 rough = make_plastic(1.5, 0.8, make_microfacets(FacetDistribution::ggx, 0.2, 0.2));
  for (const bool is_smooth : {true, false}) {
    test::BareScene shop = room;
    shop.sphere(shop.material(is_smooth ? smooth : rough), 0.5, 2);
    const StoredSignals now = signals_of(shop.scene);
    EXPECT_TRUE(std::holds_alternative<SignalMatrix>(fit(now, shop.scene)));
    StoredSignals old = now;
    old.provenance.light_hash = light_keys(shop.scene).light_hash;
    const StoredSignals oldest = without_light(now);
    for (const StoredSignals& signals : {old, oldest}) {
      if (is_smooth)
        EXPECT_EQ(misfit_of(signals, shop.scene), Misfit::coats);
      else
        EXPECT_TRUE(std::holds_alternative<SignalMatrix>(fit(signals, shop.scene)));
    }
  }
}

TEST(FittingSignals, OfOlderFilesHaveTheLabelsAndCandidatesOfTheirStore) {
  const Scene scene = test::scene_of(sample());
  const StoredSignals old = without_light(signals_of(scene));
  StoredSignals fewer = old;
  fewer.labels.pop_back();
  fewer.mean.resize(fewer.rows() * fewer.columns());
  EXPECT_EQ(misfit_of(fewer, scene), Misfit::store);
  StoredSignals other = old;
  other.labels.back().id = "other";
  EXPECT_EQ(misfit_of(other, scene), Misfit::labels);
  other = old;
  other.transceivers.front().id = "other";
  EXPECT_EQ(misfit_of(other, scene), Misfit::transceivers);
  // The order may be another.
  StoredSignals exchanged = old;
  std::swap(exchanged.labels[0], exchanged.labels[1]);
  const auto found = fit(exchanged, scene);
  EXPECT_EQ(std::get<SignalMatrix>(found).mean[0], old.mean[old.at(1, 0)]);
}

TEST(FittingSignals, AreWhole) {
  const Scene scene = test::scene_of(sample());
  const StoredSignals all = signals_of(scene);
  StoredSignals signals = all;
  signals.states.emplace();
  EXPECT_EQ(misfit_of(signals, scene), Misfit::states);
  signals = all;
  signals.part.emplace();
  EXPECT_EQ(misfit_of(signals, scene), Misfit::part);
  signals = all;
  signals.provenance.complete = false;
  EXPECT_EQ(misfit_of(signals, scene), Misfit::incomplete);
}

TEST(FittingSignals, HaveThePathsOfTheSimulation) {
  Json store = sample();
  store["fixtures"][2]["material"] = "foil";
  const Scene scene = test::scene_of(store);
  StoredSignals signals = signals_of(scene);
  const auto fits = [&](const std::string& estimator, const PathRules& wanted) {
    signals.provenance.estimator = estimator;
    const auto found = fit(signals, scene, wanted);
    if (const auto* reason = std::get_if<MisfitReason>(&found)) {
      EXPECT_EQ(reason->code, Misfit::paths);
    }
    return std::holds_alternative<SignalMatrix>(found);
  };
  const PathRules all, three{.max_bounces = 3}, walk{.strategy = Strategy::walk},
      particle{.strategy = Strategy::particle};
  for (const char* complete :
       {by_reuse, "uniform mis (power), direct exact", "uniform nee, direct sampled", ""})
    EXPECT_TRUE(fits(complete, all)) << complete;
  for (const char* other : {"uniform walk, direct sampled", "particle, direct sampled", "another program",
                            "uniform mis (balance), direct exact, at most 3 bounces"})
    EXPECT_FALSE(fits(other, all)) << other;
  EXPECT_TRUE(fits("uniform nee, direct exact, at most 3 bounces", three));
  EXPECT_FALSE(fits("uniform nee, direct exact, at most 30 bounces", three));
  EXPECT_FALSE(fits(by_reuse, three));
  EXPECT_TRUE(fits("uniform walk, direct sampled", walk));
  EXPECT_TRUE(fits("particle, direct sampled", particle));
  EXPECT_FALSE(fits("particle, direct sampled", walk));
}

}  // namespace
}  // namespace shelfbeam
