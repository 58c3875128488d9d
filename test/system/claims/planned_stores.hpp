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

/// Gives the values of a plan states in one of 8 ways: none, as up to version 0.4, or assumed, given and
/// confirmed ones. In the ways 2 and 7, a threshold is assumed.
void know_values(std::uint32_t way, CertifiedPlan& plan);

/// A plan for a shop that changes.
PlannedStore planned_for_states();

/// Makes it a plan by spend, with the same units.
void put_prices(PlannedStore& store);

}  // namespace shelfbeam::test
