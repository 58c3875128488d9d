#pragma once

#include <cstdint>

#include "shelfbeam/placement/problem/placement_problem.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam {

// Seeds of the samples of certificates. A plan that was changed after its certificate had been read is
// another question, and is certified by fresh samples: the ones that suggested the change would favour it.

/// `table`: the signals on which units are first placed, with all constraints.
std::uint64_t question_key(std::uint64_t seed, const SignalTable& table, const PlacementProblem& problem);

/// For the verification of all units of a scene.
std::uint64_t question_key(std::uint64_t seed, const Scene& units, const PlacementProblem& problem);

}  // namespace shelfbeam
