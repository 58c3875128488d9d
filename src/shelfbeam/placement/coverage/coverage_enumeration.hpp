#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/coverage/coverage_proof.hpp"
#include "shelfbeam/placement/coverage/coverage_table.hpp"
#include "shelfbeam/placement/problem/effort.hpp"

namespace shelfbeam::detail {

/// The result of `enumerate_coverage`.
struct CoverageEnumeration {
  /// Ascending, with the installed units and without conflicts; empty if no selection of the weight was seen.
  std::optional<Selection> selected = {};
  double weight = 0;  ///< of `selected`
  /// Every selection was examined or excluded, or Aim::first was achieved.
  bool is_complete = false;
  CoverageProof proof = {};  ///< if complete, that no selection weighs more; without steps if it is too long
};

enum class EnumerationAim {
  first,  ///< any selection of the weight
  best    ///< the selection of the largest weight
};

/// Examines all selections of at most `units` units, installed ones included, that may reach the weight
/// `needed` of labels: depth first, in an order that the table alone decides, without the subtrees whose
/// upper bound is below that weight (docs/methods/placement.md, "Max coverage"). Meant for few units.
///
/// If complete, no selection weighs at least `needed` and LabelWeights::step more than `selected`
/// (Aim::best), or none weighs `needed` (without `selected`). Ends incomplete at the limits, immediately if
/// the table or the number of units is too large, and early if the work left is far too little.
CoverageEnumeration enumerate_coverage(CoverageTable& table, const LabelWeights& weights, std::size_t units,
                                       double needed, EnumerationAim aim, Effort& left,
                                       const RunControl& control);

}  // namespace shelfbeam::detail
