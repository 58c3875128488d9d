#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/plan/answer/certified_plan.hpp"
#include "shelfbeam/plan/answer/value_bounds.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

// Sentences about the count, the objective and their proofs.

/// (count - proven_count) / count.
double count_gap(const Placement& placement);

/// The count equals its proven lower bound.
bool count_is_proven(const Placement& placement);

/// The certificate leaves nothing open: all labels are reached, and the minimum is certified. No second
/// objective remains.
bool is_certified_minimum(const CertifiedPlan& plan);

/// "1,800 EUR", "1,799.50": with two decimals unless whole (six digits if these are not enough), and the
/// currency if there is one.
std::string money(const Words& words, double amount, const std::optional<Price>& price);

/// The same for a lower bound, rounded down.
std::string at_least(const Words& words, double bound, const std::optional<Price>& price);

/// "Price of the units: 1,800 EUR." Empty without prices.
std::string price_sentence(const Words& words, const Placement& placement);

/// "at least 1 transceiver is needed"
std::string units_needed(const Words& words, std::size_t count_bound);

/// With a selection: "it is proven that 3 are not enough", the same of the cost, or units_needed().
std::string terminal_bound(const Words& words, const Placement& placement);
/// The same as the end of a sentence on the page: "; it is proven that 3 are not enough."
std::string page_bound(const Words& words, const Placement& placement);

/// "exhaustive search, log checked"
std::string_view bound_proof_text(const Words& words, BoundProof proof);

/// "Method of proof: exhaustive search, log checked." Empty where nothing is proven.
std::string proof_sentence(const Words& words, const Placement& placement);

/// "fewest transceivers, then fewest links"
std::string objective_name(const Words& words, const PlacementProblem& problem);

/// "The secondary objective (links) is 1000.": one or two sentences. Empty where the count is the only
/// objective.
std::string objective_sentence(const Words& words, const Placement& placement);

/// "optimal (proven)"
std::string_view status_name(const Words& words, Status status);

/// "search with highs 1.10.0", "not needed"
std::string solver_text(const Words& words, const SolvedBy& solver);

// Sentences about the certificate.

/// "4 transceivers reach all 390 labels, and 3 are not enough, with 99 % confidence.": one or more
/// sentences, which state what the confidence covers and what not. Empty without a certificate.
std::string certificate_sentence(const Words& words, const CertifiedPlan& plan, bool has_scope = true);

/// "390 of 390 labels are reached for all reflectances within their ranges, with 99 % confidence; ...":
/// the result of the simulations at the ends of the ranges, as one sentence.
/// Precondition: the plan has them.
std::string sensitivity_sentence(const Words& words, const CertifiedPlan& plan, std::size_t labels);

}  // namespace shelfbeam
