// Tests whether certificates hold for plans that were changed after reading certificates.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "shelfbeam/math/order.hpp"
#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/plan/plan.hpp"
#include "shelfbeam/plan/validation_estimates.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/transport/run/matrix_rows.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

#include "support/temp_folder.hpp"
#include "unit/plan/fresh_batches.hpp"
#include "unit/plan/plan_store.hpp"

namespace shelfbeam {
namespace {

constexpr std::uint32_t units = 24;
constexpr double confidence = 0.99;

SimulationOptions few_samples(std::uint64_t seed, std::uint64_t per_batch) {
  SimulationOptions options{EstimatorKind::uniform};
  options.direct = DirectLight::exact;
  options.samples = batch_count * per_batch;
  options.seed = seed;
  return options;
}

// Under the ceiling of a dark room, a label receives light from spots on the floor, one of each unit, after a
// single reflection: its signals have large, nearly independent errors, and are known by quadrature. The
// units have powers such that each signal is 1. No two units suffice, but nearly.
class NarrowShop {
 public:
  NarrowShop() : scene_(shop()) {
    for (Transceiver& unit : scene_.transceivers) unit.relative_power = 1 / signal(unit.position);
    set_requirement(scene_, 2.002);
  }

  const Scene& scene() const { return scene_; }
  /// The true signals of a scene with some of the units, and other prices and requirements.
  static SignalMatrix truth(const Scene& scene) {
    SignalMatrix truth = detail::matrix_head(scene, "", 0, "");
    truth.mean.assign(scene.transceivers.size(), 1);
    truth.standard_error = truth.direct = std::vector<float>(scene.transceivers.size());
    return truth;
  }
  static void set_requirement(Scene& scene, double requirement) {
    scene.label_types[0].threshold = requirement;
  }

 private:
  static constexpr Vec2 size{5, 4};
  static constexpr Vec3 label{2.5, 2, 2.8};
  static constexpr double reflectance = 0.5, order = 8;

  static Scene shop() {
    std::string list;
    for (std::uint32_t j = 0; j < units; ++j)
      list += fmt::format(R"({}{{"id": "T{}", "position": [{}, {}, 2.9], "type": "spot"}})", j > 0 ? "," : "",
                          j, 0.5 + 0.8 * (j % 6), 0.5 + std::floor(j / 6.0));
    Scene scene = make_scene(parse_store(
        fmt::format(
            R"({{"room": {{"size": [{}, {}, 3], "floor": "paper", "ceiling": "black", "walls": "black"}},
            "materials": {{"paper": {{"type": "lambertian", "reflectance": {}}},
                           "black": {{"type": "lambertian", "reflectance": 0}}}},
            "label_types": {{"l": {{"threshold": 1}}}}, "labels": [
              {{"id": "L", "position": [{}, {}, {}], "normal": [0, 0, -1], "type": "l"}}],
            "transceiver_types": {{"spot": {{"emission": {{"type": "lambertian", "order": {}, "flux": 1}}}}}},
            "transceivers": {{"list": [{}]}}}})",
            size[0], size[1], reflectance, label.x, label.y, label.z, order, list),
        "narrow.json", "."));
    scene.store_hash.clear();
    return scene;
  }

  static double signal(const Vec3& unit) {
    constexpr int steps = 400;
    double sum = 0;
    for (int x = 0; x < steps; ++x)
      for (int y = 0; y < steps; ++y) {
        const Vec3 floor{size[0] * (x + 0.5) / steps, size[1] * (y + 0.5) / steps, 0};
        const double from = length(floor - unit), to = length(floor - label);
        const double intensity = (order + 1) / (2 * pi) * std::pow(unit.z / from, order);
        sum += intensity * (unit.z / from) / (from * from) * std::pow(label.z / to, 2) / (to * to);
      }
    return sum * reflectance / pi * size[0] * size[1] / (steps * steps);
  }

  Scene scene_;
};

// Comparisons at 5 standard errors each: with normal errors, a correct program fails with a probability of
// 6e-7 for each unit.
TEST(SecondThoughts, NarrowShopHasKnownSignals) {
  const NarrowShop shop;
  const SignalMatrix matrix = simulate(shop.scene(), few_samples(1, 20'000)).matrix;
  for (std::size_t j = 0; j < units; ++j) {
    EXPECT_NEAR(static_cast<double>(matrix.mean[j]), 1, 5 * static_cast<double>(matrix.standard_error[j]));
    EXPECT_LT(matrix.standard_error[j], 0.03F);
  }
}

struct Pair {
  std::uint32_t a = 0, b = 0;
  double lower = 0;  ///< confidence limit of the signal of both
};

// The pair that looks best in some samples, among those that seem to suffice on a matrix.
Pair luckiest_pair(const Scene& scene, const SignalMatrix& matrix, std::uint64_t seed) {
  std::vector<Pair> pairs;
  for (std::uint32_t b = 1; b < units; ++b)
    for (std::uint32_t a = 0; a < b; ++a) pairs.push_back({a, b});
  const auto sums_of = [&](std::size_t, std::span<const double> signals, std::span<double> sums) {
    for (std::size_t k = 0; k < pairs.size(); ++k) sums[k] = signals[pairs[k].a] + signals[pairs[k].b];
  };
  const ValidationEstimates found =
      test::fresh_estimates(scene, few_samples(seed, 4096), 64, pairs.size(), sums_of);
  Pair best;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [a, b, none] = pairs[k];
    const double planned = static_cast<double>(matrix.mean[a]) + static_cast<double>(matrix.mean[b]);
    const double lower = found.sums[k].lower(1 - confidence);
    if (planned >= matrix.labels[0].requirement && lower > best.lower) best = {a, b, lower};
  }
  return best;
}

// The question after a change of mind, so that the pair is chosen.
Scene changed(const Scene& scene, const Pair& pair, std::uint64_t kind) {
  Scene now = scene;
  switch (kind) {
    case 0:  // its price is lower
      now.transceiver_types.push_back(now.transceiver_types[0]);
      now.transceiver_types.back().cost = 0.5;
      for (const std::uint32_t j : {pair.a, pair.b}) now.transceivers[j].type = TransceiverTypeId{1};
      break;
    case 1:  // it is mounted already
      for (const std::uint32_t j : {pair.a, pair.b}) now.transceivers[j].installed = true;
      break;
    case 2:  // others are excluded
      now.transceivers = {scene.transceivers[pair.a], scene.transceivers[pair.b]};
      break;
    default:  // and the requirement is the limit of its signal
      now.transceivers = {scene.transceivers[pair.a], scene.transceivers[pair.b]};
      NarrowShop::set_requirement(now, pair.lower * (1 - 1e-9));
  }
  return now;
}

// More than that a unit is needed.
bool states_something(const Certificate& certificate) {
  const Verdict verdict = certificate.labels[0].verdict;
  return verdict == Verdict::reached || verdict == Verdict::missed || certificate.count_lower_bound > 1 ||
         certificate.cost_lower_bound > 1;
}

bool is_false(const Plan& plan, const SignalMatrix& truth, const PlacementProblem& problem) {
  const Certificate& certificate = *plan.certificate;
  // Without a selection, a missed label is one that all units miss.
  const bool has_selection = !plan.placement.selected.empty();
  const auto selected = has_selection ? plan.placement.selected : all_numbers<ColumnId>(truth.columns());
  double received = 0;
  for (const std::uint32_t j : selected) received += static_cast<double>(truth.mean[j]);
  const bool is_reached = received >= truth.labels[0].requirement;
  const Verdict verdict = certificate.labels[0].verdict;
  if ((verdict == Verdict::reached && !is_reached) || (verdict == Verdict::missed && is_reached)) return true;
  const Placement best = place(make_signal_table(truth), problem, {});
  return best.has_selection() && (certificate.count_lower_bound > best.count() ||
                                  certificate.cost_lower_bound > best.objective_value * (1 + 1e-9));
}

// Cancels a plan when a step begins.
struct StopAt : ProgressSink {
  explicit StopAt(Task at) : step(at) {}
  void report(Task task, double, std::string_view) override {
    if (task == step) token.request();
  }
  Task step;
  CancelToken token;
};

// Without a simulation there is no checkpoint, and the certificate begins again.
TEST(SecondThoughts, ContinueToTheSameCertificate) {
  test::PlanStore store;
  store.threshold = 0.075;
  const Scene scene = store.scene();
  const test::TempFolder folder;
  PlanOptions options;
  options.simulation = few_samples(3, 16);
  options.simulation.checkpoint = {folder / "checkpoint", true, 0};
  options.place.step_limit = 1 << 20;
  options.budget.samples = 8'000'000;
  options.signals = {simulate(scene, few_samples(4, 16)).matrix};
  const Plan whole = make_plan(scene, options);
  ASSERT_TRUE(whole.complete && whole.certificate);
  for (const Task step : {Task::verifying, Task::proving}) {
    StopAt stop(step);
    const Plan part = make_plan(scene, options, {.cancel = &stop.token, .progress = &stop});
    ASSERT_FALSE(part.complete) << to_text(step);
    EXPECT_TRUE(std::holds_alternative<ReusedSignals>(*part.signals));
    const Plan rest = make_plan(scene, options);
    EXPECT_TRUE(rest.complete);
    EXPECT_EQ(rest.simulation.matrix, whole.simulation.matrix);
    EXPECT_EQ(rest.placement.selected, whole.placement.selected);
    EXPECT_EQ(rest.certificate->count_lower_bound, whole.certificate->count_lower_bound);
    for (std::size_t i = 0; i < scene.labels.size(); ++i)
      EXPECT_EQ(rest.certificate->labels[i].lower, whole.certificate->labels[i].lower);
  }
}

// Another price leaves the selection, but makes another question.
TEST(SecondThoughts, TakeFreshSamples) {
  test::PlanStore store;
  store.threshold = 0.075;
  Scene scene = store.scene();
  PlanOptions options;
  options.simulation = few_samples(3, 16);
  options.budget.samples = 100'000;
  options.signals = {simulate(scene, few_samples(4, 16)).matrix};
  const Plan first = make_plan(scene, options), same = make_plan(scene, options);
  scene.store_hash.clear();
  scene.transceiver_types[0].cost = 2;
  const Plan other = make_plan(scene, options);
  ASSERT_TRUE(first.certificate && same.certificate && other.certificate);
  EXPECT_EQ(other.placement.selected, first.placement.selected);
  for (std::size_t i = 0; i < scene.labels.size(); ++i) {
    EXPECT_EQ(same.certificate->labels[i].signal, first.certificate->labels[i].signal);
    EXPECT_NE(other.certificate->labels[i].signal, first.certificate->labels[i].signal);
  }
}

// Samples of certificates are keyed by seed and question (TakeFreshSamples), so a plan that was changed after
// samples had been read is certified by others. 200 plans are changed so that the pair is chosen which looks
// best among all, planned on the same signals with the same seed, and certified at 99 %: at most 6 of their
// certificates may be false (if each is with a probability of 1 %, more are with 0.4 %). The control states
// that the pair suffices by the samples that chose it: the limit of each pair holds at 99 %, but that of the
// best one often fails. About half of the pairs are decided (100 and 96 with two budgets), so 70 statements
// are more than three standard deviations below.
TEST(SecondThoughtsSlow, AreCertifiedByFreshSamples) {
  const NarrowShop shop;
  int wrong = 0, wrong_control = 0, reused = 0, pairs = 0, stated = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    PlanOptions options;
    options.simulation = few_samples(seed, 256);
    options.place.step_limit = 1 << 16;
    options.budget.samples = 100'000;
    options.confidence = confidence;
    options.problem.combination = Combination::spend;
    const Plan first = make_plan(shop.scene(), options);
    ASSERT_TRUE(first.certificate);
    const Pair pair = luckiest_pair(shop.scene(), first.simulation.matrix, seed);
    const Scene scene = changed(shop.scene(), pair, seed % 4);
    options.signals = {first.simulation.matrix};
    const Plan plan = make_plan(scene, options);
    ASSERT_TRUE(plan.certificate);
    reused += std::holds_alternative<ReusedSignals>(*plan.signals) ? 1 : 0;
    pairs += plan.placement.count() == 2 ? 1 : 0;
    stated += states_something(*plan.certificate) ? 1 : 0;
    wrong += is_false(plan, NarrowShop::truth(scene), options.problem) ? 1 : 0;
    const double requirement = scene.label_types[0].threshold;
    wrong_control += requirement > 2 && pair.lower >= requirement ? 1 : 0;
  }
  EXPECT_EQ(reused, 200);
  EXPECT_GT(pairs, 100);
  EXPECT_GT(stated, 70);
  EXPECT_LE(wrong, 6);
  EXPECT_GT(wrong_control, 20);
  RecordProperty("wrong", wrong);
  RecordProperty("wrong_control", wrong_control);
}

}  // namespace
}  // namespace shelfbeam
