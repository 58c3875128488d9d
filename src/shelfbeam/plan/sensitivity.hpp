#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/problem/instance.hpp"
#include "shelfbeam/plan/answer/sensitivity.hpp"
#include "shelfbeam/plan/verification.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// One material after the other is examined at so many labels at least, those with the least margins where
/// all reflectances are low. A label has no less there with one material low, and the least margin is no more
/// than that where all are high. So all labels whose margin at the low end is up to that are watched, too, as
/// long as the materials one by one cost no more than the two ends do, which are simulated at every label.
inline constexpr std::size_t least_watched_labels = 256;

/// Simulates the transceivers of a scene (all of them are mounted) with all reflectances at the low and at
/// the high ends of their ranges, and with those of one material after the other, and says which labels fall
/// short and which material matters most. All simulations have the same random numbers, so that differences
/// are known better than signals are. Materials that no surface has are left out.
///
/// Ranges are the scene's (NamedMaterial::reflectance_range), else `assumed_error` to both sides, up to 0.99
/// at most (or the reflectance, if that is higher): a room whose surfaces all reflected everything would have
/// no end of light.
///
/// `planned` has the signals that the placement was chosen on, m x n row by row. They tell which of a label's
/// links, or which sum without one unit, margins are those of; verdicts are those of `verify`. Throws as
/// that.
Sensitivity reflectance_sensitivity(const Scene& scene, const Question& question,
                                    std::span<const float> planned, const SensitivityOptions& options,
                                    const VerificationEffort& effort, const RunControl& control = {});

}  // namespace shelfbeam
