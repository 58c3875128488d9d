#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

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
    /// row: it is unmet, and b = 0.
    row_fails,
    /// weights, price: no b allowed columns are worth enough. With s_i = `shift` lacking_i / b (0 where links
    /// are counted) and d_i = lacking_i - b s_i: sum_i w_i d_i > price C + the b largest sum_i w_i min(d_i,
    /// max(0, a_ij - s_i)) - price c_j among allowed columns (none negative). It is no answer because b
    /// columns that give lacking_i together give d_i beyond s_i each.
    sum_fails,
    /// weights, price: columns with which that would hold are no longer allowed; the same node goes on.
    filter,
    /// Every allowed column leaves some label unmet, so do the chosen ones alone, and b = 1.
    single_fails,
    /// The chosen columns cost too much.
    cost_fails,
    /// row, by_cost, count, then that many columns, each followed by the child that takes it; it is not
    /// allowed in later children. Pigeonhole: a selection that meets the row has a column with
    /// a_ij >= lacking_i / b, and, with costs, one with a_ij >= lacking_i c_j / C. All of these that are
    /// allowed are listed.
    branch
  };

  /// Where units add up, what each gives of its even share is not counted: whoever gives more then stands
  /// out, and the bound is sharper than without.
  static constexpr double shift = 0.3;

  std::size_t most_units = 0;
  std::int64_t most_cost = 0;
  bool is_complete = false;
  std::vector<std::uint32_t> rows;  ///< of the table, to which weights refer
  /// By the upper and lower half of their number.
  std::vector<std::vector<std::vector<float>>> weights;
  std::vector<std::uint32_t> steps;  ///< prices as the bits of a float
};

struct CheckLimits {
  std::chrono::steady_clock::time_point until = std::chrono::steady_clock::time_point::max();
  RunControl control = {};
};

enum class ProofVerdict {
  holds,
  left_open,   ///< the search has not logged all that it did
  unfinished,  ///< the limits came first
  refuted
};

/// Examines a proof in double precision from the table alone: nothing of the search is used but the proof.
ProofVerdict judge_proof(const SignalTable& table, const Question& question, const Proof& proof,
                         const CheckLimits& limits = {});

}  // namespace shelfbeam::detail
