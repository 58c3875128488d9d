#include "shelfbeam/milp/objective_scale.hpp"

#include <algorithm>
#include <cmath>

namespace shelfbeam::milp::detail {

double objective_scale(std::span<const Column> columns) {
  double largest = 0;
  bool whole = true;
  for (const Column& column : columns) {
    largest = std::max(largest, std::abs(column.cost));
    whole = whole && column.cost == std::round(column.cost);
  }
  if (largest == 0 || (whole && largest <= 1e6)) return 1;
  return std::ldexp(1.0, std::clamp(10 - (std::ilogb(largest) + 1), -1020, 1020));
}

}  // namespace shelfbeam::milp::detail
