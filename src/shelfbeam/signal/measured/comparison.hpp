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

// Measured signals beside simulated ones and the one factor between them; docs/methods/comparison.md has the
// equations.

/// A measured signal and what the simulation says of it.
struct ComparedPair {
  std::uint32_t label = 0;
  std::optional<std::uint32_t> transceiver;  ///< nothing: of several units at once
  double measured = 0;
  std::optional<double> error;  ///< of `measured`
  double simulated = 0;         ///< W/m^2
  double standard_error = 0;    ///< of `simulated`; of a sum at most this
};

/// The measurements with the entries of the matrix; where they are of several units at once with the sum over
/// `units` (columns). Standard errors from few batches are enlarged to what Student's t spreads.
std::vector<ComparedPair> compared_pairs(const SignalMatrix& matrix, const Measurements& measurements,
                                         std::span<const std::uint32_t> units = {});

/// What a pair does for the fit.
enum class PairUse {
  fitted,
  uncertain,  ///< too faint: for the simulation, or beside the error of the measurement; decides nothing
  nothing_measured  ///< 0 or less, where a clear signal is expected
};

struct PairResult {
  PairUse use = PairUse::uncertain;
  double expected = 0;             ///< factor x simulated
  std::optional<double> residual;  ///< dB, 10 log10(measured / expected); nothing where either is not above 0
  double standardized = 0;         ///< the difference in its standard deviations; 0 where these are not known
  bool outlier = false;
};

struct Interval {
  double low = 0, high = 0;
  bool holds(double value) const { return low <= value && value <= high; }
};

/// Which errors that pairs share made the interval as wide as it is.
enum class SharedErrors { none, of_labels, of_transceivers, of_both };

/// Whether the errors explain all differences from one factor: the least chi-square; where errors of
/// measurements are known.
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
  std::vector<PairResult> pairs;  ///< as handed in
  std::size_t fitted = 0, uncertain = 0, nothing_measured = 0;
  double confidence = 0;
  double factor = 0;  ///< measured per simulated
  Interval factor_interval;
  SharedErrors shared = SharedErrors::none;
  double spread = 0;           ///< dB, standard deviation beyond all known errors
  double median_residual = 0;  ///< dB, of absolute residuals of fitted pairs
  double ninety_residual = 0;  ///< dB, 90 % of them
  double correlation = 0;      ///< of the fitted pairs in dB; 0 where one side does not vary
  /// d log measured / d log simulated: 1 where a factor is all; nothing where the signals hardly vary.
  std::optional<double> slope;
  Interval slope_interval;
  std::optional<OneFactorTest> test;
  std::vector<std::size_t> outliers;              ///< pairs, largest first
  std::vector<std::size_t> worst;                 ///< the other fitted pairs, largest absolute residual first
  std::vector<TransceiverResidual> transceivers;  ///< of fitted pairs, in the order of the matrix
};

/// Fits the factor. Throws InputError, in which `name` stands for the measurements, with fewer than three
/// pairs to fit, or where most of what should be strong is not above 0.
Comparison compare_signals(std::span<const ComparedPair> pairs, double confidence = 0.95,
                           const std::string& name = "measurements");

}  // namespace shelfbeam
