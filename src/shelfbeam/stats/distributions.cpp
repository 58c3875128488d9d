#include "shelfbeam/stats/distributions.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace shelfbeam {

double normal_quantile(double p) {
  return boost::math::quantile(boost::math::normal(), p);
}

double student_quantile(double p, double degrees_of_freedom) {
  if (std::isinf(degrees_of_freedom)) return normal_quantile(p);
  return boost::math::quantile(boost::math::students_t(degrees_of_freedom), p);
}

double chi_square_upper_tail(double x, double degrees_of_freedom) {
  return boost::math::cdf(boost::math::complement(boost::math::chi_squared(degrees_of_freedom), x));
}

double success_probability_upper_limit(std::uint64_t successes, std::uint64_t trials, double level) {
  if (successes >= trials) return 1;
  return boost::math::quantile(
      boost::math::complement(boost::math::beta_distribution<>(static_cast<double>(successes + 1),
                                                               static_cast<double>(trials - successes)),
                              level));
}

double sidak_level(double level, double statements) {
  return -std::expm1(std::log1p(-level) / statements);
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const double place = q * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(place);
  const std::size_t high = std::min(low + 1, values.size() - 1);
  return values[low] + (place - static_cast<double>(low)) * (values[high] - values[low]);
}

}  // namespace shelfbeam
