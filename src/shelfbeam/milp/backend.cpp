#include "shelfbeam/milp/bound_report.hpp"

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

}  // namespace shelfbeam::milp::detail
