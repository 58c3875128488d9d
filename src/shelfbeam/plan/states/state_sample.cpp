#include "shelfbeam/plan/states/state_sample.hpp"

#include "shelfbeam/plan/sub_scene.hpp"
#include "shelfbeam/transport/run/prepared_scene.hpp"

namespace shelfbeam {

void StateSample::simulate(const Scene& part, const std::function<void(const StateSignals&)>& use) const {
  const auto first = prepare(part, options_, true, control_);
  simulate_states([&](std::uint64_t k) { return states_.state(StateNumbers(k), part); }, *first, options_,
                  {.first = 0, .count = count_, .batches = batches}, use, log_, "sample", control_);
}

void StateSample::fill(StateTable& table, std::span<const std::uint32_t> labels, std::size_t first) const {
  if (labels.empty()) return;
  simulate(sub_scene(scene_, labels),
           [&](const StateSignals& state) { set_state(table, state.state, first, state.signals); });
}

std::vector<double> StateSample::received(std::span<const std::uint32_t> labels,
                                          std::span<const std::uint32_t> units,
                                          const PlacementProblem& problem) const {
  std::vector<double> result(labels.size() * count_);
  if (labels.empty() || units.empty()) return result;
  simulate(sub_scene(scene_, labels, units), [&](const StateSignals& state) {
    for (std::size_t i = 0; i < labels.size(); ++i) {
      ReceivedSignal received(problem);
      for (std::size_t j = 0; j < units.size(); ++j)
        received.add(static_cast<double>(state.signals.mean[i * units.size() + j]));
      result[i * count_ + state.state] = received.value();
    }
  });
  return result;
}

}  // namespace shelfbeam
