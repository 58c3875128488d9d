#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "shelfbeam/plan/answer/certified_plan.hpp"

namespace shelfbeam {

// Parts of sentences about an answer that the terminal and the report share.

/// "exhaustive search, its log checked"
std::string_view behind_bound(BoundProof proof);

/// "12 pairs of candidates are kept apart: units must be 2 m apart"; empty where nothing was asked for.
std::string kept_apart(const Placement& placement);

/// "a mounting point holds one unit and units must be 2 m apart": why each label could be reached, but not
/// all of them at once. `has_options`: some mounting points have several candidates. Empty where nothing is
/// known to exclude anything.
std::string why_exclusive(const Placement& placement, bool has_options);

/// "no light arrives at all": why Unreachable::most is 0. `is_heard`: the label has some entry above 0.
std::string_view why_nothing(const Question& question, bool is_heard);

/// "4 transceivers reach all 390 labels, and 3 cannot, with joint confidence 99 %": what a certificate says,
/// a sentence or several. Empty without one.
std::string statement(const CertifiedPlan& plan);

/// What it does not cover.
inline constexpr std::string_view certificate_scope =
    "The confidence covers the error of sampling, for these candidates, materials and this geometry.";

/// "390 of 390 labels are reached wherever in their ranges the reflectances are, with joint confidence 99 %":
/// what simulations at their ends say of so many labels; a sentence.
std::string statement(const Sensitivity& sensitivity, std::size_t labels);

}  // namespace shelfbeam
