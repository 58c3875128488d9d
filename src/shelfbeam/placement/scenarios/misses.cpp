#include "shelfbeam/placement/scenarios/misses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "shelfbeam/stats/distributions.hpp"

namespace shelfbeam {

namespace {

constexpr double level_rounding = 1e-12;

std::uint64_t beyond(std::uint64_t misses, std::uint64_t allowed) {
  return misses > allowed ? misses - allowed : 0;
}

}  // namespace

std::uint64_t ScenarioMisses::total() const {
  return std::accumulate(of_label.begin(), of_label.end(), std::uint64_t{0});
}

std::uint64_t MissAllowance::limit(std::size_t label) const {
  std::uint64_t limit = std::numeric_limits<std::uint64_t>::max();
  if (!of_label.empty()) limit = of_label[label];
  if (of_shop) limit = std::min<std::uint64_t>(limit, *of_shop);
  if (total) limit = std::min(limit, *total);
  return limit;
}

std::uint64_t MissAllowance::excess(const ScenarioMisses& misses) const {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < of_label.size(); ++i) sum += beyond(misses.of_label[i], of_label[i]);
  if (of_shop) sum += beyond(misses.of_shop, *of_shop);
  if (total) sum += beyond(misses.total(), *total);
  return sum;
}

std::uint32_t allowed_misses(double availability, std::size_t scenarios) {
  return static_cast<std::uint32_t>(std::floor((1 - availability) * static_cast<double>(scenarios) + 1e-9));
}

// With k misses, scenarios - k - 1 successes or fewer have at most this probability if the true share is at
// least their upper limit.
std::uint32_t widened_misses(double availability, std::size_t scenarios, double level) {
  for (std::uint32_t k = 0; k < scenarios; ++k)
    if (success_probability_upper_limit(scenarios - k - 1, scenarios, level) <=
        availability * (1 + level_rounding))
      return k;
  return static_cast<std::uint32_t>(scenarios);
}

std::optional<std::uint32_t> proving_misses(double availability, std::size_t scenarios, double level) {
  std::optional<std::uint32_t> proving;
  for (std::uint32_t k = 0; k < scenarios; ++k) {
    if (success_probability_upper_limit(k, scenarios, level) > (1 - availability) * (1 + level_rounding))
      break;
    proving = k;
  }
  return proving;
}

}  // namespace shelfbeam
