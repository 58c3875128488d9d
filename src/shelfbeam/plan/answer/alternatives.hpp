#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "shelfbeam/placement/problem/spend.hpp"

namespace shelfbeam {

/// A selection as a user compares it with others. Labels and margins follow the rules of the placement.
struct Alternative {
  Selection selected;               ///< ascending
  std::optional<Price> price = {};  ///< nothing if the table has no prices
  std::size_t reached = 0;          ///< labels
  std::size_t max_reached = 0;      ///< no selection of as many units reaches more; 0: not examined
  double smallest_margin = 0;       ///< min_i S_i / (gamma_i tau_i); infinite without labels
  std::size_t secure = 0;           ///< labels that stay reached if any one chosen unit fails
  bool is_proven = false;           ///< no selection of its kind is better: see Alternatives
};

/// Other answers to the same question, for a comparison. Each is nothing where it does not apply or was not
/// found.
struct Alternatives {
  /// As many labels as one unit fewer can reach; proven if `reached` equals `max_reached`.
  std::optional<Alternative> one_fewer;
  /// The placement with the candidate that raises the smallest margin most.
  std::optional<Alternative> one_more;
  /// All labels, even if any one unit fails; proven if no selection is cheaper or, with equal prices,
  /// smaller.
  std::optional<Alternative> survives_failure;
  bool cannot_survive = false;  ///< proven: no selection survives every failure

  bool empty() const { return !one_fewer && !one_more && !survives_failure && !cannot_survive; }
};

}  // namespace shelfbeam
