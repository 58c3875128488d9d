#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shelfbeam/signal/measured/measurements.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam {

// Compares measured with simulated signals and fits the factor between them. Equations:
// docs/methods/comparison.md.

/// A measured signal and the simulated signal.
struct ComparedPair {
  LabelId label;
  std::optional<ColumnId> transceiver;  ///< nothing: several units at once
  double measured = 0;
  std::optional<double> error;  ///< standard deviation of `measured`
  double simulated = 0;         ///< W/m^2
  double standard_error = 0;    ///< of `simulated`; for several units an upper limit
};

/// Pairs the measurements with entries of the matrix, or with sums over `units` (columns) if several units
/// were measured at once. Standard errors from few batches are enlarged to the spread of Student's t.
std::vector<ComparedPair> compared_pairs(const SignalMatrix& matrix, const Measurements& measurements,
                                         std::span<const ColumnId> units = {});

/// The role of a pair in the fit.
enum class PairUse {
  fitted,
  uncertain,     ///< too faint for the simulation or for the error of the measurement; ignored
  measured_zero  ///< 0 or less although a clear signal is expected
};

struct PairResult {
  PairUse use = PairUse::uncertain;
  double expected = 0;             ///< factor x simulated
  std::optional<double> residual;  ///< dB, 10 log10(measured / expected); nothing unless both are above 0
  double standardized = 0;         ///< the difference in standard deviations; 0 if these are unknown
  bool outlier = false;
};

struct Interval {
  double low = 0, high = 0;
  bool holds(double value) const { return low <= value && value <= high; }
};

/// The shared errors that determine the width of the interval.
enum class SharedErrors { none, of_labels, of_transceivers, of_both };

/// Tests by the minimum chi-square whether the errors explain all differences from a single factor. Requires
/// known errors of the measurements.
struct OneFactorTest {
  double statistic = 0, degrees_of_freedom = 0, p_value = 0;
  bool rejected() const { return p_value < level; }
  static constexpr double level = 0.01;
};

struct TransceiverResidual {
  std::uint32_t transceiver = 0;
  std::size_t pairs = 0;
  double median = 0;  ///< dB
};

struct Comparison {
  std::vector<PairResult> pairs;  ///< in the order of the input
  std::size_t fitted = 0, uncertain = 0, measured_zero = 0;
  double confidence = 0;
  double factor = 0;  ///< measured over simulated
  Interval factor_interval;
  SharedErrors shared = SharedErrors::none;
  double spread = 0;                ///< dB, standard deviation in excess of all known errors
  double median_residual = 0;       ///< dB, median of the absolute residuals of fitted pairs
  double residual_quantile_90 = 0;  ///< dB, their 90 % quantile
  double correlation = 0;           ///< of the fitted pairs in dB; 0 if either side is constant
  /// d log measured / d log simulated: 1 for a pure factor; nothing if the signals hardly vary.
  std::optional<double> slope;
  Interval slope_interval;
  std::optional<OneFactorTest> test;
  std::vector<std::size_t> outliers;              ///< pairs, largest first
  std::vector<std::size_t> worst;                 ///< the other fitted pairs, largest absolute residual first
  std::vector<TransceiverResidual> transceivers;  ///< of fitted pairs, in the order of the matrix
};

/// Fits the factor. Throws InputError, which names the measurements as `name`, if fewer than three pairs can
/// be fitted or if most of the signals expected to be strong are not above 0.
Comparison compare_signals(std::span<const ComparedPair> pairs, double confidence = 0.95,
                           const std::string& name = "measurements");

}  // namespace shelfbeam
