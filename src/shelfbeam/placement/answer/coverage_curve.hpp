#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "shelfbeam/placement/answer/placement.hpp"

namespace shelfbeam {

/// Bounds on the weight of labels, in the unit of SignalTable::Label::weight.
struct WeightRange {
  double at_least = 0, at_most = 0;
};

/// Bounds on the number of labels that at most `units` units can reach, and on their weight.
struct CurvePoint {
  std::size_t units = 0;
  std::size_t at_least = 0;                  ///< labels; some selection reaches this many
  std::size_t at_most = 0;                   ///< labels; proven upper bound
  std::optional<WeightRange> weight = {};    ///< if the table has weights
  BoundProof miss_proof = BoundProof::dual;  ///< of an upper bound below the number of labels
};

struct CoverageCurve {
  std::vector<CurvePoint> points;  ///< one per number of units; neither bound falls
  Selection selected;              ///< smallest selection seen that reaches every label; ascending
  bool is_complete = true;         ///< no interruption or limit cut the curve short
};

}  // namespace shelfbeam
