#pragma once

#include <cstdint>
#include <vector>

#include "system/claims/truth.hpp"

namespace shelfbeam::test {

/// Plans of small stores by number, the same on every machine: counts, prices and sums, both communication
/// models, with unit failure, installed units, little and ample budgets, several confidences, and some
/// without a certificate, without a selection, or interrupted. Some placements begin with a better bound than
/// the later searches find, so that the certified bound may be above that of the final matrix.
PlannedStore planned_store(std::uint32_t number);

/// A plan for a shop that changes.
PlannedStore planned_for_states();

/// Makes it a plan by spend, with the same units.
void put_prices(PlannedStore& store);

}  // namespace shelfbeam::test
