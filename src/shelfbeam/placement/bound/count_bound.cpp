#include "shelfbeam/placement/bound/count_bound.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "shelfbeam/base/deadline.hpp"

namespace shelfbeam::detail {

namespace {

/// What a bound was found with, for the next count: its shares are so much smaller that all units together
/// give the same below them.
std::vector<BoundRow> rows_for(const LpBound& bound, std::size_t count) {
  std::vector<BoundRow> rows = rows_of(bound);
  const auto units = static_cast<double>(count);
  for (BoundRow& row : rows) row.share *= units / (units + 1);
  return rows;
}

}  // namespace

CountBound count_bound(const SignalTable& table, const Question& question, const milp::Backend& backend,
                       double time_limit_s, const RunControl& control) {
  const Deadline deadline(time_limit_s);
  const std::vector<double> ones(table.columns(), 1.0);
  CountBound result;
  result.relaxation = lp_bound(table, question, ones, backend, {.time_limit_s = time_limit_s}, control);
  result.complete = result.relaxation.complete;
  result.count = static_cast<std::size_t>(std::max(0.0, std::ceil(result.relaxation.dual.bound)));
  if (question.model != CommunicationModel::cooperative) return result;

  std::vector<BoundRow> rows = rows_for(result.relaxation, 0);
  while (result.complete && result.count < table.columns()) {
    // Anything above k will do, and what is not clearly above it is none the better for rounding up.
    const double enough = static_cast<double>(result.count) + 1e-6;
    const LpBound limited = lp_bound(table, question, ones, backend,
                                     {.time_limit_s = deadline.seconds_left(),
                                      .enough = enough,
                                      .answers = {.most = result.count},
                                      .rows = std::move(rows)},
                                     control);
    if (limited.dual.bound < enough &&
        !(limited.complete &&
          needs_more(table, question, backend, result.count, limited, deadline.seconds_left(), control))) {
      result.complete = limited.complete;
      break;
    }
    rows = rows_for(limited, result.count);
    ++result.count;
  }
  return result;
}

}  // namespace shelfbeam::detail
