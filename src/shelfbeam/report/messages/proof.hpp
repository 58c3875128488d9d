#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/plan/answer/certified_plan.hpp"

namespace shelfbeam {

// How few units can do it, what was minimised beside their number, and what proves that.

/// The least number of units that is proven to be needed: the bound rounded up; 0 where no number suffices.
std::size_t least_count(const Placement& placement);

/// (count - least_count) / count.
double count_gap(const Placement& placement);

/// A selection of so many units is one of the fewest.
bool count_is_proven(const Placement& placement);

/// "at least 1 transceiver is needed"
std::string units_needed(std::size_t least);

/// Where a selection was found: "fewer cannot, proven", or how many are needed.
std::string terminal_bound(const Placement& placement);
/// The same as the end of a sentence on the page: "; at least 4 are needed (proven)."
std::string page_bound(const Placement& placement);

/// "exhaustive search, its log checked"
std::string_view behind_bound(BoundProof proof);

/// "What is proven rests on exhaustive search, its log checked." Empty where nothing is.
std::string proof_sentence(const Placement& placement);

/// "fewest transceivers, then fewest links"
std::string objective_name(const Question& question);

/// "Among selections of this size the aim was the least sum over links: 1000.": a sentence or two. Empty
/// where only the number counts.
std::string objective_sentence(const Placement& placement);

/// "optimal (proven)"
std::string_view status_name(Status status);

// What fresh samples say of a plan.

/// "4 transceivers reach all 390 labels, and 3 cannot reach all, with joint confidence 99 %.": a sentence or
/// several. Empty without a certificate.
std::string certificate_sentence(const CertifiedPlan& plan);

/// What it does not cover.
inline constexpr std::string_view certificate_scope =
    "The confidence covers the error of sampling, for these candidates, materials and this geometry.";

/// "390 of 390 labels are reached wherever in their ranges the reflectances are, with joint confidence 99 %":
/// what simulations at their ends say of so many labels; a sentence.
std::string sensitivity_sentence(const Sensitivity& sensitivity, std::size_t labels);

}  // namespace shelfbeam
