#include "shelfbeam/plan/states/risk_causes.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "shelfbeam/plan/states/reflectance_ends.hpp"
#include "shelfbeam/plan/sub_scene.hpp"
#include "shelfbeam/stats/moments.hpp"
#include "shelfbeam/transport/run/prepared_scene.hpp"
#include "shelfbeam/transport/states/simulate_states.hpp"

namespace shelfbeam {

namespace {

constexpr std::uint32_t states_per_cause = 60, batches_per_state = 64;
constexpr std::uint64_t first_state = 900'000'000;  ///< beyond those of samples and rounds
constexpr double uniform_variance = 1.0 / 12;       ///< of a number between 0 and 1

using SignalMoments = std::vector<Moments>;  ///< per label

class Causes {
 public:
  Causes(const StoreStates& states, const Scene& units, const PlacementProblem& problem,
         const SimulationOptions& options, ResultLog& log, const RunControl& control)
      : states_(states),
        low_(units),
        high_(with_reflectances_at(RangeEnd::high, units)),
        problem_(problem),
        options_(options),
        log_(log),
        control_(control),
        first_(prepare(low_, options, false, control)) {}

  // States in which one cause changes, or nothing: these differ by sampling alone.
  SignalMoments moments(std::optional<Cause> cause) const {
    return moments(
        *first_, [&](std::uint64_t k) { return states_.state(StateNumbers::only(cause, k), low_); },
        cause ? fmt::format("cause {}", to_text(*cause)) : "no cause");
  }
  SignalMoments moments_at_high_reflectances() const {
    const auto first = prepare(high_, options_, false, control_);
    return moments(
        *first,
        [&](std::uint64_t k) {
          return with_reflectances_at(RangeEnd::high, states_.state(StateNumbers::only({}, k), high_));
        },
        "high reflectances");
  }

 private:
  SignalMoments moments(const PreparedScene& first, const StateMaker& states,
                        const std::string& purpose) const {
    const std::size_t columns = low_.transceivers.size();
    SignalMoments signal(low_.labels.size());
    simulate_states(
        states, first, options_, {first_state, states_per_cause, batches_per_state},
        [&](const StateSignals& state) {
          for (std::size_t i = 0; i < signal.size(); ++i) {
            ReceivedSignal received(problem_);
            for (std::size_t j = 0; j < columns; ++j)
              received.add(static_cast<double>(state.signals.mean[i * columns + j]));
            signal[i].add(received.value());
          }
        },
        log_, purpose, control_);
    return signal;
  }

  const StoreStates& states_;
  const Scene& low_;
  Scene high_;
  const PlacementProblem& problem_;
  const SimulationOptions& options_;
  ResultLog& log_;
  const RunControl& control_;
  std::unique_ptr<const PreparedScene> first_;
};

}  // namespace

std::vector<LabelAtRisk> risk_causes(const StoreStates& states, const Scene& units,
                                     std::span<const LabelId> labels, const PlacementProblem& problem,
                                     const SimulationOptions& options, ResultLog& log,
                                     const RunControl& control) {
  labels = labels.first(std::min(labels.size(), max_labels_at_risk));
  std::vector<LabelAtRisk> result;
  for (const LabelId i : labels) result.push_back({i, {}});
  if (labels.empty() || units.transceivers.empty()) return result;
  const Scene part = sub_scene(units, labels);
  const Causes causes(states, part, problem, options, log, control);
  const SignalMoments as_given = causes.moments({});
  const auto add = [&](std::string_view cause, const auto& variance_of) {
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const double variance = std::max(0.0, variance_of(i)), mean = as_given[i].mean();
      result[i].causes.push_back({std::string(cause), variance, mean > 0 ? std::sqrt(variance) / mean : 0});
    }
  };
  for (const Cause cause : states.causes()) {
    const SignalMoments changed = causes.moments(cause);
    add(to_text(cause), [&](std::size_t i) { return changed[i].variance() - as_given[i].variance(); });
  }
  if (states.varies(Cause::reflectance) && has_reflectance_range(part)) {
    const SignalMoments high = causes.moments_at_high_reflectances();
    add("reflectance", [&](std::size_t i) {
      const double range = high[i].mean() - as_given[i].mean();
      const double noise = (high[i].variance() + as_given[i].variance()) / states_per_cause;
      return uniform_variance * (range * range - noise);
    });
  }
  for (LabelAtRisk& label : result) {
    double sum = 0;
    for (const CauseShare& cause : label.causes) sum += cause.share;
    for (CauseShare& cause : label.causes) cause.share = sum > 0 ? cause.share / sum : 0;
    std::stable_sort(label.causes.begin(), label.causes.end(),
                     [](const CauseShare& a, const CauseShare& b) { return a.share > b.share; });
  }
  return result;
}

}  // namespace shelfbeam
