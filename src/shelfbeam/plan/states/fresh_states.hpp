#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/plan/answer/availability.hpp"

namespace shelfbeam {

/// Numbers of the first states of the rounds that answer a question (question_key). No two rounds, no sample
/// and no verification share a state, and different questions hardly ever. Numbers are exact in JSON.
inline std::uint64_t first_fresh_state(std::uint64_t question, std::uint32_t round) {
  constexpr std::uint64_t states_per_round = 1'000'000, rounds = 1'000, questions = 4'000'000;
  return (question % questions * rounds + round) * states_per_round;
}

/// The round of a verification, beyond those of plans.
inline constexpr std::uint32_t verifying_round = 500;

/// The result of one round.
struct FreshStates {
  StateOutcome outcome;
  std::vector<ShownState> shown;  ///< the first states, and one with the most missed labels
  bool certified = false;
  bool out_of_time = false;
  /// Labels whose misses do not allow the statement, most misses first; with other goals than that for
  /// labels, all labels that are missed.
  std::vector<LabelId> undecided;
};

/// The labels that do not count as reached in state k, ascending (StateExamination::missed).
using MissedLabels = std::function<std::vector<LabelId>(std::uint64_t k)>;

struct FreshStatesOptions {
  std::uint64_t question = 0;
  std::uint32_t round = 1;  ///< 1, 2, ...
  double level = 0.01;      ///< the probability that a false goal is certified; looks share it
  /// Numbers of states after which the round may end with the statement.
  std::vector<std::uint32_t> looks = {300, 450, 600, 900, 1200};
  bool ends_early = true;  ///< when it is clear or probable that no later look succeeds
};

/// Examines one plan in fresh states until the goal is certified at a look, or the states or the time end.
///
/// Labels: if the goal is false, some label, which one does not depend on the states, has too small an
/// availability, and the statement requires the limit of this label, among others, to meet it
/// (intersection-union test; Berger 1982). So labels do not share the level.
FreshStates examine(const MissedLabels& missed_in, const AvailabilityGoal& goal,
                    const std::vector<double>& required, const FreshStatesOptions& options,
                    const Deadline& deadline, const RunControl& control);

}  // namespace shelfbeam
