#include "shelfbeam/stats/distributions.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

namespace shelfbeam {
namespace {

// Relative tolerance 1e-12: the closed forms and tables have 15 digits, and the library about as many.
void expect_close(double value, double reference) {
  EXPECT_NEAR(value / reference, 1, 1e-12) << reference;
}

TEST(Distributions, NormalQuantiles) {
  EXPECT_EQ(normal_quantile(0.5), 0);
  expect_close(normal_quantile(0.975), 1.959963984540054);
  expect_close(normal_quantile(0.025), -1.959963984540054);
  expect_close(normal_quantile(0.999), 3.090232306167813);
  for (const double q : {0.3, 1e-3, 1e-10, 1e-20})
    expect_close(std::erfc(-normal_quantile(q) / std::sqrt(2)) / 2, q);
  EXPECT_THROW(normal_quantile(1.5), std::domain_error);
}

// Student's distribution function for an even number of degrees of freedom (Abramowitz and Stegun 26.7.4).
double student_cdf(double t, int degrees_of_freedom) {
  const double angle = std::atan(t / std::sqrt(degrees_of_freedom)), cosine = std::cos(angle);
  double term = 1, sum = 1;
  for (int k = 1; k < degrees_of_freedom / 2; ++k) {
    term *= (2 * k - 1) / (2.0 * k) * cosine * cosine;
    sum += term;
  }
  return 0.5 + std::sin(angle) / 2 * sum;
}

TEST(Distributions, StudentQuantiles) {
  for (const double q : {0.4, 0.1, 0.025, 1e-4, 1e-9}) {
    expect_close(student_quantile(q, 1), -1 / std::tan(std::numbers::pi * q));
    expect_close(student_quantile(q, 2), (2 * q - 1) / std::sqrt(2 * q * (1 - q)));
  }
  for (const double p : {0.6, 0.9, 0.975, 0.999})
    for (const int degrees : {2, 4, 10, 30})
      expect_close(student_cdf(student_quantile(p, degrees), degrees), p);
  EXPECT_EQ(student_quantile(0.9, std::numeric_limits<double>::infinity()), normal_quantile(0.9));
  // Negative control: even a million degrees of freedom differ from the normal distribution.
  EXPECT_GT(student_quantile(0.975, 1e6) / normal_quantile(0.975), 1 + 1e-7);
}

TEST(Distributions, ChiSquareUpperTail) {
  for (const double x : {0.1, 1.0, 10.0, 200.0}) {
    expect_close(chi_square_upper_tail(x, 1), std::erfc(std::sqrt(x / 2)));
    expect_close(chi_square_upper_tail(x, 2), std::exp(-x / 2));
    expect_close(chi_square_upper_tail(x, 4), std::exp(-x / 2) * (1 + x / 2));
  }
  expect_close(chi_square_upper_tail(18.307038053275146, 10), 0.05);
  EXPECT_EQ(chi_square_upper_tail(0, 3), 1);
}

TEST(Distributions, SidakLevel) {
  EXPECT_DOUBLE_EQ(sidak_level(0.05, 1), 0.05);
  expect_close(sidak_level(0.19, 2), 0.1);
  expect_close(sidak_level(0.271, 3), 0.1);
  // To first order equal to Bonferroni's, but larger; 1 - pow(1 - level, 1/n) would keep only four digits
  // here.
  const double many = sidak_level(0.01, 1e12);
  expect_close(many, -std::log1p(-0.01) / 1e12);
  EXPECT_GT(many, 0.01 / 1e12);
}

}  // namespace
}  // namespace shelfbeam
