#include "shelfbeam/device/direction_densities.hpp"

#include <algorithm>
#include <cmath>

namespace shelfbeam::detail {

namespace {

/// The integral of s sin(begin + s) from 0 to h.
double moment(double begin, double h) {
  // sin(begin) (h sin h + cos h - 1) + cos(begin) (sin h - h cos h); a series where the brackets cancel.
  const double q = h * h;
  const double a = h < 0.2 ? q * (1.0 / 2 - q * (1.0 / 8 - q * (1.0 / 144 - q * (1.0 / 5760 - q / 403200))))
                           : h * std::sin(h) - 2 * std::sin(h / 2) * std::sin(h / 2);
  const double b =
      h < 0.2 ? h * q * (1.0 / 3 - q * (1.0 / 30 - q * (1.0 / 840 - q * (1.0 / 45360 - q / 3991680))))
              : std::sin(h) - h * std::cos(h);
  return std::sin(begin) * a + std::cos(begin) * b;
}

}  // namespace

double SineSegment::integral_to(double reach) const {
  const double plain = 2 * std::sin(begin + reach / 2) * std::sin(reach / 2);
  const double rising = moment(begin, reach) / (end - begin);
  return std::max(0.0, first * (plain - rising) + last * rising);
}

double SineSegment::invert(double part) const {
  const double width = end - begin, total = integral();
  if (!(part > 0)) return begin;
  if (part >= total) return end;
  // Newton's method, safeguarded by shrinking bounds, from the solution for a linear density.
  double low = 0, high = width;
  double reach = width * invert_linear_density(first * std::sin(begin), last * std::sin(end), part / total);
  for (int step = 0; step < 60; ++step) {
    const double excess = integral_to(reach) - part;
    (excess < 0 ? low : high) = reach;
    const double density = (first + (last - first) * reach / width) * std::sin(begin + reach);
    double next = reach - excess / density;
    // Newton's steps square the relative error, so after a step of 1e-8 only rounding remains.
    if (std::abs(next - reach) <= 1e-8 * std::min(next, width - next)) return begin + next;
    if (!(next > low && next < high)) next = (low + high) / 2;
    if (high - low <= 1e-15 * width) return begin + next;
    reach = next;
  }
  return begin + reach;
}

double invert_linear_density(double first, double last, double u) {
  const double root = std::sqrt(std::max(0.0, first * first + u * (last - first) * (last + first)));
  const double divisor = first + root;
  return divisor > 0 ? std::min(1.0, u * (first + last) / divisor) : u;
}

}  // namespace shelfbeam::detail
