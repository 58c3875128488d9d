#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "shelfbeam/plan/answer/certified_plan.hpp"

namespace shelfbeam {

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
