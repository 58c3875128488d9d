#include "shelfbeam/placement/bound/count_bound.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace shelfbeam::detail {

namespace {

/// The rows of a bound for the next count, with shares reduced so that s K stays the same.
std::vector<BoundRow> rows_for(const LpBound& bound, std::size_t count) {
  std::vector<BoundRow> rows = rows_of(bound);
  const auto units = static_cast<double>(count);
  for (BoundRow& row : rows) row.share *= units / (units + 1);
  return rows;
}

}  // namespace

CountBound count_bound(const Instance& instance, const milp::Backend& backend, const LpBoundOptions& options,
                       const RunControl& control) {
  const std::vector<double> ones(instance.columns(), 1.0);
  CountBound result;
  result.relaxation = lp_bound(instance, ones, backend, options, control);
  result.complete = result.relaxation.complete;
  result.count = static_cast<std::size_t>(std::max(0.0, std::ceil(result.relaxation.dual.bound)));
  if (!instance.is_cooperative()) return result;

  std::vector<BoundRow> rows = rows_for(result.relaxation, 0);
  while (result.complete && result.count < instance.columns()) {
    // Any bound above k proves k + 1; a bound less than 1e-6 above k may be rounding.
    const double enough = static_cast<double>(result.count) + 1e-6;
    LpBoundOptions limited = options;
    limited.enough = enough;
    limited.selections.max_count = result.count;
    limited.rows = std::move(rows);
    const LpBound found = lp_bound(instance, ones, backend, limited, control);
    if (found.dual.bound < enough &&
        !(found.complete &&
          prove_count_exceeds(instance, backend, limited.selections, found, options.effort, control))) {
      result.complete = found.complete;
      break;
    }
    rows = rows_for(found, result.count);
    ++result.count;
  }
  return result;
}

}  // namespace shelfbeam::detail
