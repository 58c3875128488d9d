// Compares the effect of reflectance ranges on a placement with the exact light in simple rooms.

#include "shelfbeam/plan/sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/plan/plan.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

#include "physics/bare_scene.hpp"
#include "unit/plan/plan_store.hpp"

namespace shelfbeam {
namespace {

SimulationOptions connections(std::uint32_t max_bounces, std::uint64_t samples_a_batch = 20) {
  SimulationOptions options{EstimatorKind::uniform};
  options.strategy = Strategy::nee;
  options.direct = DirectLight::exact;
  options.max_bounces = max_bounces;
  options.samples = batch_count * samples_a_batch;
  return options;
}

std::vector<float> signals_of(const Scene& scene, const SimulationOptions& options) {
  return simulate(scene, options).matrix.mean;
}

Sensitivity of(const Scene& scene, const SimulationOptions& simulation, const PlacementProblem& problem = {},
               double assumed_error = 0.1, std::uint64_t seed = 11, unsigned threads = 0) {
  SimulationOptions fresh = simulation;
  fresh.seed = seed;
  return reflectance_sensitivity(scene, problem, signals_of(scene, simulation), {assumed_error, 0.99},
                                 {fresh, 64}, {.threads = threads});
}

Scene plan_scene(double low, double high) {
  Scene scene = test::PlanStore{.threshold = 0.02, .across = 1}.scene();
  scene.materials[0].reflectance_range = {low, high};
  return scene;
}

// A sphere of albedo rho and area A adds rho^k Phi / A at bounce k, everywhere on its wall.
struct Sphere {
  double rho = 0.6, lower = 0.3, upper = 0.8;

  test::BareScene room() const {
    test::BareScene room;
    room.sphere(room.material(Lambertian{rho}), 2, 4);
    room.scene.materials[0].reflectance_range = {lower, upper};
    room.unit({0.5, 0.3, -0.4}, normalized({1, 2, -1}), IsotropicHemisphere{0.25});
    const TriangleMesh& mesh = room.scene.mesh;
    for (const std::size_t part : {3, 8, 14}) {
      const auto& [a, b, c] = mesh.triangles[part * mesh.triangles.size() / 20];
      const Vec3 middle = (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3;
      room.label(middle * (1 - 1e-5), -normalized(middle));
    }
    for (LabelType& type : room.scene.label_types) type.threshold = 0.01;
    return room;
  }

  // The change of a signal, as a multiple of the requirement.
  double change(double to, bool once) const {
    const test::BareScene all = room();
    const auto reflected = [&](double albedo) { return once ? albedo : albedo / (1 - albedo); };
    return (reflected(to) - reflected(rho)) * power(all.scene.transceiver_types[0].emission) /
           all.mesh_area() / 0.01;
  }
};

// Each of four changes has a probability of about 1e-4 to be five errors off (64 batches). The control is a
// change 5 % off.
TEST(SensitivitySlow, ChangesAreThoseOfASphere) {
  const Sphere sphere;
  const Scene scene = sphere.room().scene;
  for (const bool once : {true, false}) {
    const Sensitivity found = of(scene, connections(once ? 1 : PathRules::no_limit, 2500));
    ASSERT_EQ(found.materials.size(), 1U);
    const MaterialSensitivity& wall = found.materials[0];
    EXPECT_FALSE(wall.is_assumed);
    for (const auto& [step, reflectance] :
         {std::pair(wall.at_lower, sphere.lower), std::pair(wall.at_upper, sphere.upper)}) {
      const double truth = sphere.change(reflectance, once);
      EXPECT_GT(step.change_error, 0);
      EXPECT_NEAR(step.change, truth, 5 * step.change_error) << once << reflectance;
      EXPECT_GT(std::abs(step.change - 1.05 * truth), 5 * step.change_error) << once << reflectance;
    }
  }
}

// The light of one bounce is proportional to the reflectance: with the same random numbers, within rounding.
TEST(Sensitivity, OneBounceScalesWithTheReflectance) {
  const Sensitivity found = of(plan_scene(0.3, 0.9), connections(1));
  const ReflectanceStep &less = found.materials[0].at_lower, &more = found.materials[0].at_upper;
  EXPECT_LT(less.mean_change, -0.05);
  EXPECT_NEAR(less.mean_change, -more.mean_change, 1e-5);
  // With many bounces it is not proportional.
  const Sensitivity many = of(plan_scene(0.3, 0.9), connections(PathRules::no_limit));
  EXPECT_GT(many.materials[0].at_upper.mean_change, -1.5 * many.materials[0].at_lower.mean_change);
}

TEST(Sensitivity, DirectLightDoesNotDependOnReflectance) {
  const Sensitivity found = of(plan_scene(0, 1), connections(0));
  for (const ReflectanceStep& step : {found.materials[0].at_lower, found.materials[0].at_upper}) {
    EXPECT_EQ(step.change, 0);
    EXPECT_EQ(step.change_error, 0);
    EXPECT_EQ(step.mean_change, 0);
    EXPECT_EQ(step.min_margin.ratio, found.as_given.ratio);
  }
  EXPECT_EQ(found.low.min_margin.ratio, found.high.min_margin.ratio);
  EXPECT_EQ(found.low.missed, found.high.missed);
}

// Separate materials for floor, walls and shelves, for both estimators.
Scene three_materials() {
  Scene scene = plan_scene(0.4, 0.8);
  scene.materials.push_back({"floor", Lambertian{0.5}, std::array{0.2, 0.8}});
  scene.materials.push_back({"dark", Lambertian{0.6}, std::array{0.59, 0.61}});
  for (std::size_t t = 0; t < scene.mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = scene.mesh.triangles[t];
    const double highest =
        std::max({scene.mesh.vertices[a].z, scene.mesh.vertices[b].z, scene.mesh.vertices[c].z});
    if (highest < 1e-9)
      scene.mesh.materials[t] = MaterialId{1};
    else if (highest < 2.9)
      scene.mesh.materials[t] = MaterialId{2};
  }
  return scene;
}

SimulationOptions reuse() {
  SimulationOptions options{EstimatorKind::reuse};
  options.direct = DirectLight::exact;
  options.samples = std::uint64_t{batch_count} * 64;
  return options;
}

TEST(Sensitivity, MoreReflectionIsMoreLight) {
  const Scene scene = three_materials();
  for (const SimulationOptions& options : {connections(PathRules::no_limit), reuse()}) {
    const Sensitivity found = of(scene, options);
    ASSERT_EQ(found.materials.size(), 3U);
    EXPECT_EQ(found.watched, scene.labels.size());
    for (const MaterialSensitivity& one : found.materials) {
      EXPECT_LT(one.at_lower.min_margin.ratio, found.as_given.ratio) << one.material;
      EXPECT_GT(one.at_upper.min_margin.ratio, found.as_given.ratio) << one.material;
      EXPECT_LT(one.at_lower.mean_change, 0);
      EXPECT_GT(one.at_upper.mean_change, 0);
      EXPECT_LT(found.low.min_margin.ratio, one.at_lower.min_margin.ratio);
      EXPECT_GT(found.high.min_margin.ratio, one.at_upper.min_margin.ratio);
    }
    EXPECT_EQ(found.materials.back().material, "dark") << "it hardly has a range";
    EXPECT_LE(found.materials[0].at_lower.min_margin.ratio, found.materials[1].at_lower.min_margin.ratio);
  }
}

// With independent random numbers the error of a difference would combine those of both signals.
TEST(Sensitivity, DifferencesAreMorePreciseThanSignals) {
  const Sensitivity found = of(three_materials(), connections(PathRules::no_limit, 60));
  for (const MaterialSensitivity& one : found.materials) {
    const double independent =
        std::hypot(one.at_lower.min_margin.standard_error, found.as_given.standard_error);
    EXPECT_LT(one.at_lower.change_error, 0.6 * independent) << one.material;
    EXPECT_GT(one.at_lower.change_error, 0);
  }
}

TEST(SensitivitySlow, IsTheSameForAnyNumberOfThreads) {
  const Scene scene = three_materials();
  for (const SimulationOptions& options : {connections(PathRules::no_limit, 20), reuse()}) {
    const Sensitivity one = of(scene, options, {}, 0.1, 11, 1), three = of(scene, options, {}, 0.1, 11, 3);
    const Sensitivity other = of(scene, options, {}, 0.1, 12, 3);
    EXPECT_EQ(one.low.min_margin.ratio, three.low.min_margin.ratio);
    EXPECT_EQ(one.high.min_margin.standard_error, three.high.min_margin.standard_error);
    for (std::size_t k = 0; k < one.materials.size(); ++k) {
      EXPECT_EQ(one.materials[k].material, three.materials[k].material);
      EXPECT_EQ(one.materials[k].at_lower.change, three.materials[k].at_lower.change);
      EXPECT_EQ(one.materials[k].at_upper.change_error, three.materials[k].at_upper.change_error);
      EXPECT_EQ(one.materials[k].at_upper.mean_change, three.materials[k].at_upper.mean_change);
    }
    EXPECT_NE(one.materials[0].at_lower.change, other.materials[0].at_lower.change);
  }
}

// Without a range, both ends are the given value, and every problem uses the same signal as the verdicts.
TEST(Sensitivity, UsesTheSignalOfTheProblem) {
  const Scene scene = plan_scene(0.6, 0.6);
  std::vector<double> ratios;
  for (const auto model : {CommunicationModel::cooperative, CommunicationModel::non_cooperative})
    for (const bool survives : {false, true}) {
      PlacementProblem problem;
      problem.model = model;
      problem.redundant = survives;
      const Sensitivity found = of(scene, connections(PathRules::no_limit), problem);
      EXPECT_NEAR(found.as_given.ratio, found.low.min_margin.ratio, 1e-5 * found.low.min_margin.ratio);
      EXPECT_EQ(found.as_given.label, found.low.min_margin.label);
      EXPECT_NEAR(found.as_given.standard_error, found.low.min_margin.standard_error,
                  1e-4 * found.as_given.standard_error);
      EXPECT_EQ(found.materials[0].at_lower.change, 0);
      ratios.push_back(found.as_given.ratio);
    }
  for (std::size_t k = 1; k < ratios.size(); ++k) EXPECT_LT(ratios[k], 0.999 * ratios[0]);
}

// The requirement is between the signals of the weakest label at both ends.
TEST(Sensitivity, ReportsLabelsThatBecomeMissed) {
  const SimulationOptions options = connections(PathRules::no_limit, 40);
  Scene scene = plan_scene(0.4, 0.7);
  const Sensitivity first = of(scene, options);
  const double as_given = first.as_given.ratio, low = first.low.min_margin.ratio;
  ASSERT_LT(low, 0.9 * as_given);
  scene.label_types[0].threshold *= (as_given + low) / 2;
  const Sensitivity falls = of(scene, options);
  EXPECT_EQ(falls.holds(), Verdict::missed);
  EXPECT_EQ(std::count(falls.low.missed.begin(), falls.low.missed.end(), falls.low.min_margin.label), 1);
  EXPECT_TRUE(falls.high.missed.empty());
  EXPECT_TRUE(falls.high.undecided.empty());
  EXPECT_GE(falls.materials[0].at_lower.labels_short, falls.low.missed.size());
  EXPECT_EQ(falls.materials[0].at_upper.labels_short, 0U);
  scene.materials[0].reflectance_range = {0.599, 0.601};
  EXPECT_EQ(of(scene, options).holds(), Verdict::reached);
}

TEST(Sensitivity, AssumesMissingRanges) {
  Scene scene = three_materials();
  scene.materials[0].reflectance_range.reset();
  scene.materials[1] = {"mirror", make_conductor(0, 1)};
  scene.materials[2] = {"bright", make_plastic(1.5, 0.95)};
  scene.materials.push_back({"nowhere", Lambertian{0.5}});
  const Sensitivity found = of(scene, connections(2), {}, 0.25);
  EXPECT_EQ(found.kept, std::vector<std::string>{"mirror"});
  ASSERT_EQ(found.materials.size(), 2U) << "no surface is of the last";
  for (const MaterialSensitivity& one : found.materials) {
    EXPECT_TRUE(one.is_assumed);
    EXPECT_DOUBLE_EQ(one.lower, 0.75 * one.reflectance);
    EXPECT_DOUBLE_EQ(one.upper, one.material == "bright" ? 0.99 : 0.75);
  }
  const Sensitivity exact = of(scene, connections(2), {}, 0);
  EXPECT_EQ(exact.materials[0].at_lower.change, 0);
  EXPECT_EQ(exact.low.min_margin.ratio, exact.high.min_margin.ratio);
}

// Labels a, a+1, a+2 ... share one position.
void repeat_labels(Scene& scene, std::size_t count) {
  const std::size_t places = scene.labels.size();
  while (scene.labels.size() < count) {
    Label label = scene.labels[scene.labels.size() % places];
    label.id += "+" + std::to_string(scene.labels.size());
    scene.labels.push_back(label);
  }
}

TEST(Sensitivity, WatchesTheLabelsWithTheSmallestMargins) {
  Scene scene = plan_scene(0.6, 0.6);
  repeat_labels(scene, min_watched_labels + 16);
  const Sensitivity found = of(scene, connections(2, 20));
  EXPECT_EQ(found.watched, min_watched_labels);
  const MaterialSensitivity& one = found.materials[0];
  // The weakest label of a step has its index in the whole scene.
  const std::string &low = scene.labels[found.low.min_margin.label].id,
                    &step = scene.labels[one.at_lower.min_margin.label].id;
  EXPECT_EQ(low.substr(0, low.find('+')), step.substr(0, step.find('+')));
}

// If the light at the high end exceeds that of most labels at the low end, most labels may be the weakest
// when one material is low. With many materials, only as many labels are watched as time allows.
TEST(SensitivitySlow, WatchesAllLabelsThatMayHaveTheSmallestMargin) {
  constexpr std::size_t labels = 2 * min_watched_labels;
  Scene scene = plan_scene(0.05, 0.95);
  repeat_labels(scene, labels);
  const Sensitivity wide = of(scene, connections(2, 20));
  ASSERT_GT(wide.high.min_margin.ratio, 1);
  EXPECT_GT(wide.watched, min_watched_labels);
  Scene three = three_materials();
  three.materials[0].reflectance_range = {0.05, 0.95};
  repeat_labels(three, labels);
  EXPECT_EQ(of(three, connections(2, 20)).watched, min_watched_labels);
}

PlanOptions without_certificate() {
  PlanOptions options;
  options.simulation = connections(PathRules::no_limit, 16);
  options.simulation.seed = 3;
  options.confidence.reset();
  return options;
}

TEST(Plan, AddsCurveAndSensitivity) {
  const Scene scene = test::PlanStore().scene();
  PlanOptions options = without_certificate();
  Plan plan = make_plan(scene, options);
  EXPECT_FALSE(plan.sensitivity);
  EXPECT_TRUE(plan.curve.points.empty());
  options.curve = true;
  options.sensitivity = SensitivityOptions{};
  plan = make_plan(scene, options);
  ASSERT_TRUE(plan.sensitivity);
  EXPECT_EQ(plan.sensitivity->materials[0].material, "paper");
  ASSERT_EQ(plan.curve.points.size(), plan.placement.count());
  EXPECT_EQ(plan.curve.points.back().at_least, scene.labels.size());
}

// Cancels when the work on a material begins.
struct CancelAtMaterial : ProgressSink {
  void report(Task task, double, std::string_view detail) override {
    if (task == Task::sensitivity && detail == "paper") token.request();
  }
  CancelToken token;
};

TEST(Plan, KeepsItsPlacementIfSensitivityIsInterrupted) {
  const Scene scene = test::PlanStore().scene();
  PlanOptions options = without_certificate();
  options.curve = true;
  const Plan whole = make_plan(scene, options);
  options.sensitivity = SensitivityOptions{};
  CancelAtMaterial cancel;
  const Plan part = make_plan(scene, options, {.cancel = &cancel.token, .progress = &cancel});
  EXPECT_TRUE(whole.complete);
  EXPECT_FALSE(part.complete);
  EXPECT_TRUE(part.simulation.summary.complete);
  EXPECT_FALSE(part.sensitivity);
  EXPECT_EQ(part.placement.selected, whole.placement.selected);
  EXPECT_EQ(part.curve.points.size(), whole.curve.points.size());
}

}  // namespace
}  // namespace shelfbeam
