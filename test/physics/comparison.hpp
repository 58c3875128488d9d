#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

#include "support/hypothesis.hpp"

namespace shelfbeam::test {

/// Values and their references, compared by one test.
struct Comparison {
  std::vector<double> values, references, standard_errors;

  void add(double value, double reference, double standard_error) {
    values.push_back(value);
    references.push_back(reference);
    standard_errors.push_back(standard_error);
  }

  /// Compares every entry of a matrix column with one reference.
  void add_column(const SignalMatrix& matrix, std::size_t j, double reference) {
    for (std::size_t i = 0; i < matrix.rows(); ++i)
      add(matrix.mean[matrix.at(i, j)], reference, matrix.standard_error[matrix.at(i, j)]);
  }

  /// The same with all references multiplied by a wrong factor, as a control.
  Comparison with_references_times(double factor) const {
    Comparison wrong = *this;
    for (double& reference : wrong.references) reference *= factor;
    return wrong;
  }

  /// The largest relative standard error.
  double precision() const {
    double largest = 0;
    for (std::size_t k = 0; k < values.size(); ++k)
      largest = std::max(largest, standard_errors[k] / std::abs(references[k]));
    return largest;
  }

  ZTest test(double level) const {
    return z_test(values, references, standard_errors, level, batch_count - 1);
  }

  /// z-test of all values together at `level`, with the Sidak limit.
  testing::AssertionResult agrees(double level) const {
    const ZTest z = test(level);
    if (z.pass) return testing::AssertionSuccess();
    return testing::AssertionFailure()
           << "value " << z.worst << " is " << values[z.worst] << " +- " << standard_errors[z.worst]
           << " instead of " << references[z.worst] << ", |z| = " << z.largest << " > " << z.limit;
  }
};

/// z-test of all values together; their relative standard errors must be below `precision`. The control
/// multiplies the references by `wrong`, which the test must reject.
inline void expect_agreement(const Comparison& found, double precision, double wrong, const std::string& what,
                             double level = 0.001) {
  EXPECT_TRUE(found.agrees(level)) << what;
  EXPECT_LT(found.precision(), precision) << what;
  EXPECT_FALSE(found.with_references_times(wrong).agrees(level)) << what;
}

/// The entries of two independent runs, the second multiplied by a factor. Equal entries without errors are
/// omitted.
inline Comparison compare(const SignalMatrix& found, const SignalMatrix& reference, double factor = 1) {
  Comparison entries;
  for (std::size_t e = 0; e < found.mean.size(); ++e) {
    const double expected = factor * static_cast<double>(reference.mean[e]);
    const double error = std::hypot(found.standard_error[e], factor * reference.standard_error[e]);
    if (error > 0 || found.mean[e] != expected) entries.add(found.mean[e], expected, error);
  }
  return entries;
}

/// A strategy under test and its name for messages.
struct Way {
  const char* name;
  Strategy strategy;
  Heuristic heuristic = Heuristic::balance;
  EstimatorKind estimator = EstimatorKind::uniform;

  SignalMatrix simulate(const Scene& scene, std::uint64_t samples, std::uint64_t seed = 1,
                        SimulationOptions options = {}) const {
    options.samples = samples;
    options.seed = seed;
    options.strategy = strategy;
    options.heuristic = heuristic;
    options.estimator = estimator;
    return shelfbeam::simulate(scene, options).matrix;
  }
};
inline constexpr Way walk{"walk", Strategy::walk}, nee{"nee", Strategy::nee}, mis{"mis", Strategy::mis},
    mis_power{"mis, power heuristic", Strategy::mis, Heuristic::power},
    particle{"particle", Strategy::particle},
    path_reuse{"path reuse", Strategy::mis, Heuristic::balance, EstimatorKind::reuse};
/// First rays per label in 32 batches of path reuse.
inline constexpr std::uint64_t reuse_samples = std::uint64_t{32} * 131;

}  // namespace shelfbeam::test
