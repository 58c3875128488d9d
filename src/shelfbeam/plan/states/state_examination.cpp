#include "shelfbeam/plan/states/state_examination.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/placement/answer/names.hpp"
#include "shelfbeam/plan/verification.hpp"
#include "shelfbeam/transport/run/sample_batches.hpp"
#include "shelfbeam/transport/states/simulate_states.hpp"

namespace shelfbeam {

namespace {

// Labels that few batches leave open get more, at their own part of the level.
struct Stage {
  std::uint32_t batches = 0;
  double share = 0;  ///< of the level
};
constexpr std::array<Stage, 4> stages{{{4, 0.3}, {12, 0.25}, {48, 0.25}, {192, 0.2}}};
constexpr std::uint32_t choice_batches = 4;
constexpr double clearly = 3;  ///< standard errors below the requirement: more batches would not help

// The strongest link of a label may differ between states; independent batches choose it.
std::vector<float> mean_signals(const PreparedScene& prepared, const BatchRequest& request,
                                const RunControl& control) {
  const std::size_t columns = prepared.world().scene.transceivers.size();
  std::vector<double> sums(request.labels.size() * columns, 0);
  const BatchRun run = sample_batches(
      prepared, request,
      [&](const BatchRow& row) {
        for (std::size_t j = 0; j < columns; ++j) sums[row.label * columns + j] += row.values[j];
      },
      control);
  std::vector<float> means(sums.size());
  for (std::size_t e = 0; e < sums.size(); ++e)
    means[e] = run.known[e] + static_cast<float>(sums[e] / request.batches);
  return means;
}

std::uint64_t key_of(const Scene& units, const PlacementProblem& problem) {
  std::string text = fmt::format("examined {} {}\n", to_text(problem.model), problem.redundant);
  for (const Transceiver& unit : units.transceivers) text += key_text(unit);
  return hash64(text);
}

RunControl quiet(RunControl control) {
  control.progress = nullptr;
  return control;
}

}  // namespace

StateExamination::StateExamination(const StoreStates& states, const Scene& units,
                                   const PlacementProblem& problem, const SimulationOptions& options,
                                   ResultLog& log, const RunControl& control)
    : states_(states),
      units_(units),
      problem_(problem),
      options_(options),
      log_(log),
      key_(key_of(units, problem)),
      control_(quiet(control)),
      first_(prepare(units, options, false, control_)),
      labels_(all_numbers<LabelId>(units.labels.size())) {}

std::vector<LabelId> StateExamination::missed(std::uint64_t k) const {
  const std::uint64_t key = mix_key(key_, k);
  constexpr std::size_t size = sizeof(LabelId);
  if (const auto kept = log_.find(key)) {
    std::vector<LabelId> missed(kept->size() / size);
    if (!missed.empty()) std::memcpy(missed.data(), kept->data(), missed.size() * size);
    return missed;
  }
  std::vector<LabelId> missed = simulated(k);
  log_.add(key, {reinterpret_cast<const char*>(missed.data()), missed.size() * size});
  return missed;
}

std::vector<LabelId> StateExamination::simulated(std::uint64_t k) const {
  const Scene scene = make_scene(states_.state(StateNumbers(k), units_));
  SimulationOptions own = options_;
  own.seed = mix_key(mix_key(options_.seed, hash64("examined state")), k);
  std::unique_ptr<const PreparedScene> prepared;
  const ThreadLimit allowed(control_.threads);
  with_threads(control_.threads,
               [&] { prepared = std::make_unique<const PreparedScene>(scene, *first_, own, control_); });
  std::vector<LabelId> open = labels_;
  std::uint32_t batch = 0;
  const auto take = [&](std::uint32_t batches) {
    const BatchRequest request{open, own.seed, batches, batch};
    batch += batches;
    return request;
  };
  std::vector<LabelId> missed;
  for (const Stage& stage : stages) {
    std::vector<float> planned;
    if (problem_.model == CommunicationModel::non_cooperative)
      planned = mean_signals(*prepared, take(choice_batches), control_);
    const double level = stage.share * verdict_error;
    const std::vector<LabelVerdict> verdicts =
        verify(*prepared, take(stage.batches), problem_, planned,
               {.list = level, .labels = open.size(), .joint = level}, control_);
    std::vector<LabelId> still;
    for (std::size_t r = 0; r < open.size(); ++r) {
      const LabelVerdict& label = verdicts[r];
      if (is_met(label.joint_lower, label.requirement)) continue;
      const bool is_hopeless = label.signal + clearly * label.standard_error < label.requirement;
      (is_hopeless ? missed : still).push_back(open[r]);
    }
    open = std::move(still);
    if (open.empty()) break;
  }
  missed.insert(missed.end(), open.begin(), open.end());
  std::sort(missed.begin(), missed.end());
  return missed;
}

}  // namespace shelfbeam
