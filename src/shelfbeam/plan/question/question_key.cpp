#include "shelfbeam/plan/question/question_key.hpp"

#include <string_view>

#include "shelfbeam/math/content_bytes.hpp"
#include "shelfbeam/math/random.hpp"

namespace shelfbeam {

namespace {

ContentBytes of(std::string_view purpose, const PlacementProblem& problem) {
  ContentBytes bytes;
  bytes.add(purpose)
      .add(problem.model)
      .add(problem.objective)
      .add(problem.combination)
      .add(problem.share)
      .add(problem.redundant);
  return bytes;
}

}  // namespace

std::uint64_t question_key(std::uint64_t seed, const SignalTable& table, const PlacementProblem& problem) {
  ContentBytes bytes = of("place", problem);
  for (const SignalTable::Label& label : table.labels)
    bytes.add(label.id)
        .add(label.requirement)
        .add(label.single_requirement)
        .add(label.link_cost)
        .add(label.signal_cost)
        .add(label.weight);
  for (const SignalTable::Transceiver& unit : table.transceivers)
    bytes.add(unit.id).add(unit.cost).add(unit.installed).add(unit.pinned);
  for (const auto& [a, b] : table.conflicts) bytes.add(std::uint32_t{a}).add(std::uint32_t{b});
  for (const std::size_t begin : table.row_begin) bytes.add(begin);
  for (const SignalEntry& entry : table.entries)
    bytes.add(std::uint32_t{entry.transceiver}).add(entry.signal);
  return mix_key(seed, bytes.key());
}

std::uint64_t question_key(std::uint64_t seed, const Scene& units, const PlacementProblem& problem) {
  return mix_key(seed, of("verify", problem).add(scene_hash(units)).key());
}

std::uint64_t question_key(std::uint64_t fixed, const StatesQuestion& changing) {
  const auto& [scene, goal, required, confidence, states] = changing;
  ContentBytes bytes;
  bytes.add("states").add(scene_hash(scene)).add(goal.rule).add(goal.value.has_value());
  bytes.add(goal.value.value_or(0)).add(confidence).add(states);
  for (const double availability : required) bytes.add(availability);
  return mix_key(fixed, bytes.key());
}

}  // namespace shelfbeam
