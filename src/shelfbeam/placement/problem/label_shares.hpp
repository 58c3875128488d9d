#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam::detail {

/// What chosen units are to one label, in shares of its requirement that count 1 at most each (where one unit
/// must do: 1 or nothing). Good for searching; what is met is for received_signal to say.
struct LabelShares {
  double sum = 0;
  double largest = 0, second = 0;
  std::uint32_t strongest = 0;  ///< the column of `largest`

  void add(std::uint32_t column, double share) {
    sum += share;
    if (share > largest) {
      second = largest;
      largest = share;
      strongest = column;
    } else {
      second = std::max(second, share);
    }
  }

  double largest_without(std::uint32_t column) const { return column == strongest ? second : largest; }
};

/// The share of one entry.
inline double share_of(double signal, double requirement, const Question& question) {
  if (question.model == CommunicationModel::cooperative) return std::min(1.0, signal / requirement);
  return is_met(signal, requirement) ? 1 : 0;
}

/// What a label lacks that receives such shares; 0 as soon as it is met.
inline double lacking(double sum, double largest, const Question& question) {
  if (!question.redundant) return is_met(sum, 1) ? 0 : 1 - sum;
  return is_met(sum - largest, 1) ? 0 : 2 - sum;
}

}  // namespace shelfbeam::detail
