#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "shelfbeam/placement/detail/lp_bound.hpp"

namespace shelfbeam::detail {

CountBound count_bound(const SignalTable& table, const Question& question, const milp::Backend& backend,
                       double time_limit_s, const RunControl& control) {
  const auto start = std::chrono::steady_clock::now();
  const auto seconds_left = [&] {
    return time_limit_s - std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const std::vector<double> ones(table.columns(), 1.0);
  CountBound result;
  result.relaxation = lp_bound(table, question, ones, backend, {.time_limit_s = time_limit_s}, control);
  result.complete = result.relaxation.complete;
  result.count = static_cast<std::size_t>(std::max(0.0, std::ceil(result.relaxation.dual.bound)));
  if (question.model != CommunicationModel::cooperative) return result;

  std::vector<std::uint32_t> labels = result.relaxation.labels;
  while (result.complete && result.count < table.columns()) {
    // Anything above k will do, and what is not clearly above it is none the better for rounding up.
    const double enough = static_cast<double>(result.count) + 1e-6;
    LpBound limited = lp_bound(table, question, ones, backend,
                               {.time_limit_s = seconds_left(),
                                .enough = enough,
                                .most_units = result.count,
                                .labels = std::move(labels)},
                               control);
    if (limited.dual.bound < enough) {
      result.complete = limited.complete;
      break;
    }
    ++result.count;
    labels = std::move(limited.labels);
  }
  return result;
}

}  // namespace shelfbeam::detail
