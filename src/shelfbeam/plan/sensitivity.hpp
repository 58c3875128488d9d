#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/problem/placement_problem.hpp"
#include "shelfbeam/plan/answer/sensitivity.hpp"
#include "shelfbeam/plan/verification.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// Minimum number of labels watched while one material after the other changes: those with the smallest
/// margins at the joint low end. No label's margin is smaller with only one material low, and the smallest
/// margin is then at most that with all materials high. So all labels whose margin at the low end is at most
/// that value are watched, too, while all materials together cost no more than the two ends, which are
/// simulated at every label.
inline constexpr std::size_t min_watched_labels = 256;

/// Simulates all transceivers of a scene (as mounted) with all reflectances at the low ends and at the high
/// ends of their ranges, then one material after the other, and finds the labels that fall short and the
/// material with the largest effect. Common random numbers make differences more precise than signals.
/// Materials that no surface has are omitted.
///
/// Ranges are the scene's (NamedMaterial::reflectance_range), otherwise `assumed_error` to both sides, up to
/// 0.99 (or the reflectance, if higher), because a room of fully reflecting surfaces would have infinite
/// light.
///
/// `planned`: the signals of the planning matrix, m x n row by row. They determine the link, or the sum
/// without one unit, of each label's margin. Verdicts follow `verify`. Throws as `verify`.
Sensitivity reflectance_sensitivity(const Scene& scene, const PlacementProblem& problem,
                                    std::span<const float> planned, const SensitivityOptions& options,
                                    const VerificationEffort& effort, const RunControl& control = {});

}  // namespace shelfbeam
