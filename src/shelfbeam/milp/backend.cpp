#include "shelfbeam/milp/backend.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

namespace shelfbeam::milp::detail {

void BoundReport::operator()(double primal, double dual) {
  const auto now = std::chrono::steady_clock::now();
  if (control_.progress == nullptr || now < next_) return;
  next_ = now + std::chrono::milliseconds(200);
  const bool found = std::isfinite(primal) && std::abs(primal) < 1e40;
  const bool bounded = std::isfinite(dual) && std::abs(dual) < 1e40;
  std::string text = found ? fmt::format("best {:.6g}", primal) : "nothing found yet";
  if (bounded) text += fmt::format(", bound {:.6g}", dual);
  if (found && bounded && primal != 0) text += fmt::format(", gap {:.1f} %", 100 * (primal - dual) / primal);
  control_.report("solve", -1, text);
}

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
