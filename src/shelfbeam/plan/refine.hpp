#pragma once

#include <cstdint>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/plan/verification.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam {

/// Adds fresh batches to some rows of a matrix, for all columns: means and errors become those of all batches
/// together. Parts by bounce are dropped, and direct parts stay. Throws as `sample_batches`.
void refine(const Scene& scene, const std::vector<std::uint32_t>& rows, const VerificationEffort& effort,
            SignalMatrix& matrix, const RunControl& control = {});

}  // namespace shelfbeam
