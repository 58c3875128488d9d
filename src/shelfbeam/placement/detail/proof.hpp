#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/placement/instance.hpp"

namespace shelfbeam::detail {

/// The log of a tree search that found nothing: why there is no selection of at most `most_units` units and
/// `most_cost` (in the units of a SearchProblem) that meets every label.
///
/// A node is a set of chosen columns (installed ones at the root) and a set of allowed ones; b is how many
/// may still be chosen, C what they may cost. For each label, lacking is what its rule asks for less what it
/// receives; one more unit gives it a_ij at most. `steps` holds the nodes in the order of a depth-first walk,
/// each a tag with its arguments:
struct Proof {
  enum Tag : std::uint32_t {
    open,  ///< not examined: proves nothing
    /// row: it lacks more than its b best allowed columns give.
    row_fails,
    /// weights, price: sum_i w_i lacking_i > price C + the b largest sum_i w_i min(a_ij, lacking_i) - price
    /// c_j among allowed columns (none negative).
    sum_fails,
    /// weights, price: columns with which that would hold are no longer allowed; the same node goes on.
    filter,
    /// Every allowed column leaves some label unmet, so do the chosen ones alone, and b = 1.
    single_fails,
    /// The chosen columns cost too much.
    cost_fails,
    /// row, mix, count, then that many columns, each followed by the child that takes it; it is not allowed
    /// in later children. Pigeonhole: a selection that meets the row has a column with a_ij >= lacking_i
    /// times
    /// ((1 - mix) / b + mix c_j / C); all of these that are allowed are listed. `mix` is 0 or 1.
    branch
  };

  static constexpr double shift = 0.3;

  std::size_t most_units = 0;
  std::int64_t most_cost = 0;
  bool is_complete = false;
  std::vector<std::uint32_t> rows;  ///< of the table, to which weights refer
  /// By the upper and lower half of their number.
  std::vector<std::vector<std::vector<float>>> weights;
  std::vector<std::uint32_t> steps;  ///< prices as the bits of a float
};

/// Whether a proof holds, in double precision from the table alone: nothing of the search is used but the
/// proof.
bool check_proof(const SignalTable& table, const Question& question, const Proof& proof);

}  // namespace shelfbeam::detail
