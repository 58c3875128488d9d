#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace shelfbeam {

/// The smallest of 1, 2, 2.5, 5 times a power of ten that is not below `step`.
inline double round_step(double step) {
  if (!(step > 0)) return 1;
  const double decade = std::pow(10, std::floor(std::log10(step)));
  for (const double factor : {1.0, 2.0, 2.5, 5.0})
    if (factor * decade >= step * (1 - 1e-9)) return factor * decade;
  return 10 * decade;
}

/// Multiples of `step` within [low, high].
inline std::vector<double> multiples(double low, double high, double step) {
  std::vector<double> values;
  const double slack = 1e-9 * step;
  for (double k = std::ceil((low - slack) / step); k * step <= high + slack; ++k) values.push_back(k * step);
  return values;
}

/// 1, 2, 5 times powers of ten that enclose [low, high], low > 0.
inline std::vector<double> one_two_five(double low, double high) {
  std::vector<double> steps;
  const auto first = static_cast<int>(std::floor(std::log10(low)));
  const auto last = static_cast<int>(std::ceil(std::log10(high)));
  for (int decade = first; decade <= last; ++decade)
    for (const double factor : {1.0, 2.0, 5.0}) steps.push_back(factor * std::pow(10, decade));
  std::size_t begin = 0, end = steps.size() - 1;
  while (begin + 1 < end && steps[begin + 1] <= low) ++begin;
  while (end > begin + 1 && steps[end - 1] >= high) --end;
  return {steps.begin() + static_cast<std::ptrdiff_t>(begin),
          steps.begin() + static_cast<std::ptrdiff_t>(end) + 1};
}

}  // namespace shelfbeam
