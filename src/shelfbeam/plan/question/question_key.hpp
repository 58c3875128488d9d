#pragma once

#include <cstdint>
#include <span>

#include "shelfbeam/placement/problem/placement_problem.hpp"
#include "shelfbeam/plan/answer/availability.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam {

// Seeds of the samples of certificates. A plan that was changed after its certificate had been read is
// another question, and is certified by fresh samples: the ones that suggested the change would favour it.

/// `table`: the signals on which units are first placed, with all constraints.
std::uint64_t question_key(std::uint64_t seed, const SignalTable& table, const PlacementProblem& problem);

/// For the verification of all units of a scene.
std::uint64_t question_key(std::uint64_t seed, const Scene& units, const PlacementProblem& problem);

/// The further parts of a question about a shop that changes.
struct StatesQuestion {
  const Scene& scene;  ///< of the store; its store_hash covers the variation
  const AvailabilityGoal& goal;
  std::span<const double> required;  ///< availability of each label
  double confidence = 0;
  /// Number of the states on which units are placed, or in which they are verified. With store and seed, it
  /// determines the former, also if another run has simulated them.
  std::uint32_t states = 0;
};

/// `fixed`: the key of the question about the shop as the file gives it.
std::uint64_t question_key(std::uint64_t fixed, const StatesQuestion& changing);

}  // namespace shelfbeam
