#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "shelfbeam/placement/scenarios/misses.hpp"
#include "shelfbeam/plan/answer/availability.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/variation.hpp"

namespace shelfbeam {

// The goals of availability.hpp as numbers of states.

/// Throws InputError for a goal, or for causes that are left out, if no states are examined.
void expect_no_goal(const AvailabilityGoal& goal, std::span<const Cause> without = {});

/// The required availability of every label.
std::vector<double> required_availabilities(const Scene& scene, const AvailabilityGoal& goal);

/// The misses that the goal allows some labels in a number of states, by the misses of an availability.
MissAllowance allowance_of(const AvailabilityGoal& goal, const std::vector<double>& required,
                           std::span<const LabelId> labels, std::size_t states,
                           const std::function<std::uint32_t(double availability)>& misses);
/// The same by allowed_misses.
MissAllowance allowance_of(const AvailabilityGoal& goal, const std::vector<double>& required,
                           std::span<const LabelId> labels, std::size_t states);

/// The factor of the numbers of states that an availability requires, relative to 95 %: a share of misses a
/// fifth as large requires five times as many.
std::uint32_t states_factor(const AvailabilityGoal& goal, const std::vector<double>& required);

StateOutcome outcome_of(ScenarioMisses misses, std::size_t units, std::uint32_t states);

/// The labels that are missed in any state, most misses first.
std::vector<LabelId> most_missed(const StateOutcome& outcome);

/// The labels that are missed in every state, ascending.
std::vector<LabelId> always_missed(const StateOutcome& outcome);

}  // namespace shelfbeam
