#include "shelfbeam/plan/sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/plan/sub_scene.hpp"
#include "shelfbeam/stats/moments.hpp"
#include "shelfbeam/transport/run/sample_batches.hpp"

namespace shelfbeam {

namespace {

constexpr double highest_assumed = 0.99;

// The signal of a label as one linear quantity chosen on the planning matrix: the sum, the sum without the
// strongest unit, the strongest link, or the second strongest.
class CountedSignals {
 public:
  CountedSignals(const PlacementProblem& problem, std::span<const float> planned, std::size_t columns)
      : adds_up_(problem.model == CommunicationModel::cooperative), redundant_(problem.redundant) {
    if (adds_up_ && !redundant_) return;
    std::vector<std::uint32_t> order(columns);
    for (std::size_t begin = 0; begin < planned.size(); begin += columns) {
      std::iota(order.begin(), order.end(), 0U);
      std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return planned[begin + a] > planned[begin + b];
      });
      column_.push_back(order[!adds_up_ && redundant_ && columns > 1 ? 1 : 0]);
    }
  }

  template <class Signals>
  double operator()(std::size_t label, const Signals& signals) const {
    if (!adds_up_) return redundant_ && signals.size() < 2 ? 0 : static_cast<double>(signals[column_[label]]);
    double sum = 0;
    for (std::size_t j = 0; j < signals.size(); ++j)
      if (!redundant_ || j != column_[label]) sum += static_cast<double>(signals[j]);
    return sum;
  }

 private:
  bool adds_up_, redundant_;
  std::vector<std::uint32_t> column_;
};

// Signals by label and batch, analytic direct light included.
using Batches = std::vector<std::vector<float>>;

// Simulations with one changed material, at some of the labels.
class Steps {
 public:
  /// `labels`: numbers of the scene's labels in the whole scene; `planned`: their signals.
  Steps(Scene scene, std::vector<LabelId> labels, const PlacementProblem& problem,
        std::span<const float> planned, const VerificationEffort& effort, const RunControl& control)
      : scene_(std::move(scene)),
        labels_(std::move(labels)),
        counted_(problem, planned, scene_.transceivers.size()),
        simulation_(effort.simulation),
        batches_(effort.batches),
        control_(control) {
    for (const Label& label : scene_.labels) requirement_.push_back(scene_.requirement_of(label));
    as_given_ = sample(scene_);
  }

  MinMargin as_given() const { return margin_of(as_given_, weakest(as_given_)); }

  ReflectanceStep with(std::size_t material, double reflectance) const {
    Scene changed = scene_;
    changed.store_hash.clear();
    Material& surface = changed.materials[material].material;
    const bool is_other = given_reflectance(surface) != reflectance;
    if (is_other) surface = with_reflectance(surface, reflectance);
    const Batches batches = is_other ? sample(changed) : as_given_;
    ReflectanceStep step;
    const std::size_t weakest_label = weakest(batches);
    step.min_margin = margin_of(batches, weakest_label);
    double changes = 0;
    for (std::size_t i = 0; i < requirement_.size(); ++i) {
      const double before = mean(as_given_[i]), after = mean(batches[i]);
      if (before > 0) changes += after / before - 1;
      if (!is_met(after, requirement_[i])) ++step.labels_short;
    }
    step.mean_change = changes / static_cast<double>(requirement_.size());
    Moments difference;
    for (std::uint32_t b = 0; b < batches_; ++b)
      difference.add(static_cast<double>(batches[weakest_label][b]) -
                     static_cast<double>(as_given_[weakest_label][b]));
    step.change = difference.mean() / requirement_[weakest_label];
    step.change_error = difference.standard_error() / requirement_[weakest_label];
    return step;
  }

 private:
  static double mean(std::span<const float> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  }

  Batches sample(const Scene& scene) const {
    Batches batches(requirement_.size());
    const auto take = [&](const BatchRow& row) {
      batches[row.label].push_back(static_cast<float>(counted_(row.label, row.values)));
    };
    const BatchRun run = sample_batches(scene, simulation_, batches_, take, control_);
    const std::size_t columns = scene.transceivers.size();
    for (std::size_t i = 0; i < requirement_.size(); ++i) {
      const auto known = static_cast<float>(counted_(i, std::span(run.known).subspan(i * columns, columns)));
      for (float& signal : batches[i]) signal += known;
    }
    return batches;
  }

  // The label of the smallest margin, the first of several; a scene has at least one label.
  std::size_t weakest(const Batches& batches) const {
    std::vector<double> ratio(requirement_.size());
    for (std::size_t i = 0; i < ratio.size(); ++i) ratio[i] = mean(batches[i]) / requirement_[i];
    return static_cast<std::size_t>(std::min_element(ratio.begin(), ratio.end()) - ratio.begin());
  }

  MinMargin margin_of(const Batches& batches, std::size_t label) const {
    Moments moments;
    for (const float value : batches[label]) moments.add(static_cast<double>(value));
    return {moments.mean() / requirement_[label], moments.standard_error() / requirement_[label],
            labels_[label]};
  }

  const Scene scene_;
  const std::vector<LabelId> labels_;
  CountedSignals counted_;
  SimulationOptions simulation_;
  std::uint32_t batches_;
  const RunControl& control_;
  std::vector<double> requirement_;
  Batches as_given_;
};

ReflectanceEnd judged(const std::vector<LabelVerdict>& labels) {
  ReflectanceEnd end;
  for (std::uint32_t i = 0; i < labels.size(); ++i) {
    const LabelVerdict& label = labels[i];
    if (label.verdict == Verdict::missed) end.missed.push_back(i);
    if (label.verdict == Verdict::undecided) end.undecided.push_back(i);
    if (const double ratio = label.signal / label.requirement; ratio < end.min_margin.ratio)
      end.min_margin = {ratio, label.standard_error / label.requirement, i};
  }
  return end;
}

// The labels with the smallest margins at the low end, in scene order, which may fall short or may have the
// smallest margin of all within the ranges.
std::vector<LabelId> nearest_to_missing(const std::vector<LabelVerdict>& labels, double min_at_high,
                                        std::size_t materials) {
  const auto margin = [&](LabelId i) { return labels[i].signal / labels[i].requirement; };
  std::vector<LabelId> order = ordered_by<LabelId>(labels.size(), margin);
  const double up_to = std::max(1.0, min_at_high);
  const auto near = static_cast<std::size_t>(
      std::count_if(order.begin(), order.end(), [&](LabelId i) { return margin(i) <= up_to; }));
  const std::size_t affordable = labels.size() / std::max<std::size_t>(materials, 1);
  order.resize(std::min(order.size(), std::max(std::min(near, affordable), min_watched_labels)));
  std::sort(order.begin(), order.end());
  return order;
}

std::optional<MaterialSensitivity> range_of(const NamedMaterial& named, double assumed_error) {
  const auto given = given_reflectance(named.material);
  if (!given) return std::nullopt;
  MaterialSensitivity one;
  one.material = named.name;
  one.reflectance = *given;
  one.is_assumed = !named.reflectance_range;
  one.lower = one.is_assumed ? *given * (1 - assumed_error) : (*named.reflectance_range)[0];
  one.upper = one.is_assumed ? std::max(*given, std::min(highest_assumed, *given * (1 + assumed_error)))
                             : (*named.reflectance_range)[1];
  return one;
}

}  // namespace

Sensitivity reflectance_sensitivity(const Scene& scene, const PlacementProblem& problem,
                                    std::span<const float> planned, const SensitivityOptions& options,
                                    const VerificationEffort& effort, const RunControl& control) {
  const Stopwatch watch;
  Sensitivity result;
  result.confidence = options.confidence;
  result.assumed_error = options.assumed_error;
  std::vector<std::size_t> varied;
  Scene low = scene, high = scene;
  low.store_hash.clear();
  high.store_hash.clear();
  const std::vector<bool> used = scene.used_materials();
  for (std::size_t k = 0; k < scene.materials.size(); ++k) {
    if (!used[k]) continue;
    const auto range = range_of(scene.materials[k], options.assumed_error);
    if (!range) {
      result.kept.push_back(scene.materials[k].name);
      continue;
    }
    low.materials[k].material = with_reflectance(scene.materials[k].material, range->lower);
    high.materials[k].material = with_reflectance(scene.materials[k].material, range->upper);
    varied.push_back(k);
    result.materials.push_back(*range);
  }
  const double level = (1 - options.confidence) / 2;
  control.report(Task::sensitivity, -1, "all reflectances low");
  const std::vector<LabelVerdict> at_low = verify(low, problem, planned, level, effort, control);
  result.low = judged(at_low);
  control.report(Task::sensitivity, -1, "all reflectances high");
  result.high = judged(verify(high, problem, planned, level, effort, control));
  const std::vector<LabelId> watched =
      nearest_to_missing(at_low, result.high.min_margin.ratio, varied.size());
  result.watched = watched.size();
  const std::size_t columns = scene.transceivers.size();
  std::vector<float> planned_of_watched;
  for (const LabelId i : watched) {
    const auto row = planned.subspan(i * columns, columns);
    planned_of_watched.insert(planned_of_watched.end(), row.begin(), row.end());
  }
  VerificationEffort alike = effort;
  for (const MaterialSensitivity& one : result.materials)
    alike.simulation.brightest = std::max(alike.simulation.brightest, one.upper);
  const Steps steps(sub_scene(scene, watched), watched, problem, planned_of_watched, alike, control);
  result.batches = effort.batches;
  result.as_given = steps.as_given();
  for (std::size_t k = 0; k < varied.size(); ++k) {
    MaterialSensitivity& one = result.materials[k];
    control.report(Task::sensitivity, static_cast<double>(k) / static_cast<double>(varied.size()),
                   one.material);
    one.at_lower = steps.with(varied[k], one.lower);
    one.at_upper = steps.with(varied[k], one.upper);
  }
  std::stable_sort(result.materials.begin(), result.materials.end(),
                   [](const MaterialSensitivity& a, const MaterialSensitivity& b) {
                     return a.at_lower.min_margin.ratio < b.at_lower.min_margin.ratio;
                   });
  result.seconds = watch.seconds();
  return result;
}

}  // namespace shelfbeam
