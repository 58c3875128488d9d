#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "shelfbeam/placement/answer/placement.hpp"

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

}  // namespace shelfbeam
