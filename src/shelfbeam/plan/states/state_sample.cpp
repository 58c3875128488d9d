#include "shelfbeam/plan/states/state_sample.hpp"

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/plan/sub_scene.hpp"
#include "shelfbeam/transport/run/prepared_scene.hpp"

namespace shelfbeam {

void StateSample::simulate(const Scene& part, const std::function<void(const StateSignals&)>& use) const {
  const auto first = prepare(part, options_, true, control_);
  const auto numbers = [&](std::uint64_t k) {
    return which_.only ? StateNumbers::only(which_.only, k) : StateNumbers(k);
  };
  simulate_states([&](std::uint64_t k) { return states_.state(numbers(k), part); }, *first, options_,
                  {.first = 0, .count = which_.count, .batches = which_.batches}, use, log_, which_.purpose,
                  control_);
}

void StateSample::signals(std::span<const LabelId> labels, std::optional<std::span<const ColumnId>> units,
                          const std::function<void(const StateSignals&)>& use) const {
  if (which_.sampled == nullptr) {
    simulate(units ? sub_scene(scene_, labels, *units) : sub_scene(scene_, labels), use);
    return;
  }
  const std::size_t n = scene_.transceivers.size();
  for (std::uint32_t k = 0; k < which_.count; ++k) {
    control_.report(Task::reading_states, static_cast<double>(k) / which_.count);
    if (control_.cancelled()) throw Interrupted("the plan was stopped");
    const SignalLayer all = which_.sampled->state(k);
    SignalLayer part;
    const auto add = [&](std::size_t entry) {
      part.mean.push_back(all.mean[entry]);
      part.standard_error.push_back(all.standard_error[entry]);
    };
    for (const LabelId i : labels) {
      if (units)
        for (const std::uint32_t j : *units) add(i * n + j);
      else
        for (std::size_t j = 0; j < n; ++j) add(i * n + j);
    }
    use({k, part});
  }
}

void StateSample::fill(ScenarioTable& table, std::span<const LabelId> labels, std::size_t first) const {
  if (labels.empty()) return;
  signals(labels, std::nullopt,
          [&](const StateSignals& state) { set_scenario(table, state.state, first, state.signals); });
}

std::vector<double> StateSample::received(std::span<const LabelId> labels, std::span<const ColumnId> units,
                                          const PlacementProblem& problem) const {
  std::vector<double> result(labels.size() * which_.count);
  if (labels.empty() || units.empty()) return result;
  signals(labels, units, [&](const StateSignals& state) {
    for (std::size_t i = 0; i < labels.size(); ++i) {
      ReceivedSignal received(problem);
      for (std::size_t j = 0; j < units.size(); ++j)
        received.add(static_cast<double>(state.signals.mean[i * units.size() + j]));
      result[i * which_.count + state.state] = received.value();
    }
  });
  return result;
}

}  // namespace shelfbeam
