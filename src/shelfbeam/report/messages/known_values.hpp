#pragma once

#include <string>

#include "shelfbeam/plan/answer/certified_plan.hpp"

namespace shelfbeam {

class Words;

// Sentences about how well the values are known on which a plan rests. Pages, terminal, batch and planner use
// these.

/// "Verified for assumed values", for a plan whose answer is certified.
std::string verified_words(const Words& words, const CertifiedPlan& plan);

/// "threshold of standard (0.007 W/m²)"
std::string value_words(const Words& words, const DecisiveValue& value);

/// The assumed values, the most influential first; empty if nothing is assumed.
std::string assumed_sentence(const Words& words, const CertifiedPlan& plan);

/// Both, for outputs without a badge. `is_certified`: the answer of the plan is.
std::string basis_of(const Words& words, const CertifiedPlan& plan, bool is_certified);
std::string basis_of(const Words& words, const CertifiedPlan& plan);

}  // namespace shelfbeam
