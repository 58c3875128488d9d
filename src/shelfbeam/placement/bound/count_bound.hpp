#pragma once

#include <cstddef>

#include "shelfbeam/placement/bound/lp_bound.hpp"

namespace shelfbeam::detail {

/// The fewest units of an answer, bounded from below.
struct CountBound {
  std::size_t count = 0;  ///< no answer has fewer units
  LpBound relaxation;     ///< of the count, whatever it is
  bool complete = false;  ///< none of the linear programs of at most k units ended with the time
};

/// The LP bound of the count, rounded up to k; then, as long as the LP bound of the answers of at most k
/// units exceeds k, which says that there are none, or `needs_more` shows it by cases, k + 1.
CountBound count_bound(const SignalTable& table, const Question& question, const milp::Backend& backend,
                       double time_limit_s, const RunControl& control);

/// Whether all answers have more than `most` units, shown by cases where `open`, the LP bound of the answers
/// of at most so many, falls short of it by little: either some unit gives a label the share t or more, or
/// none does; each case has its own LP bound, and is divided again where that is not enough. Ends after some
/// cases, with the time or when cancelled; false where nothing was shown.
bool needs_more(const SignalTable& table, const Question& question, const milp::Backend& backend,
                std::size_t most, const LpBound& open, double time_limit_s, const RunControl& control);

}  // namespace shelfbeam::detail
