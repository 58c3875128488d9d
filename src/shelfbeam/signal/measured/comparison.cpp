#include "shelfbeam/signal/measured/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/stats/distributions.hpp"
#include "shelfbeam/stats/robust_mean.hpp"

namespace shelfbeam {

namespace {

constexpr double db_per_e = 10 / std::numbers::ln10;
constexpr double clear = 5;             // minimum signal for a logarithm, in standard errors
constexpr double min_over_noise = 2;    // the same in smallest measured signals, if errors are unknown
constexpr double outlier_level = 0.01;  // probability of any false outlier

double decibel(double ratio) {
  return 10 * std::log10(ratio);
}

/// Noise level below which a measured signal is indistinguishable from zero: its error; if unknown, the
/// smallest positive signal, provided that some measured 0; otherwise 0.
class NoiseFloor {
 public:
  explicit NoiseFloor(std::span<const ComparedPair> pairs) {
    double smallest = std::numeric_limits<double>::infinity();
    bool some_silent = false;
    for (const ComparedPair& pair : pairs) {
      if (pair.measured > 0)
        smallest = std::min(smallest, pair.measured);
      else
        some_silent = true;
    }
    smallest_ = some_silent && std::isfinite(smallest) ? smallest : 0;
  }
  double limit(const ComparedPair& pair) const {
    return pair.error ? clear * *pair.error : min_over_noise * smallest_;
  }
  /// The largest true signal that is plausible for a measurement of 0.
  double max_noise(const ComparedPair& pair) const { return pair.error ? 3 * *pair.error : smallest_; }

 private:
  double smallest_ = 0;
};

bool is_clear(const ComparedPair& pair) {
  return pair.simulated > 0 && pair.simulated >= clear * pair.standard_error;
}

/// The median ratio of the pairs that are clear on both sides, as the start of the fit. Up to half of these
/// pairs may be wrong.
double first_factor(std::span<const ComparedPair> pairs, const NoiseFloor& noise) {
  std::vector<double> ratios;
  for (const ComparedPair& pair : pairs)
    if (is_clear(pair) && pair.measured > 0 && pair.measured >= noise.limit(pair))
      ratios.push_back(pair.measured / pair.simulated);
  return quantile(std::move(ratios), 0.5);
}

struct Fit {
  std::vector<PairUse> uses;        ///< of all pairs
  std::vector<std::size_t> fitted;  ///< indices of the fitted pairs
  RobustMean mean;                  ///< mean ratio of the fitted pairs, dB
};

double factor_of(const RobustMean& mean) {
  return std::pow(10, mean.value / 10);
}

/// Selects the pairs that are clear under an approximate factor and fits the factor to them.
Fit fit_from(double factor, std::span<const ComparedPair> pairs, const NoiseFloor& noise,
             const std::string& name) {
  Fit fit;
  std::vector<double> ratios, errors;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const ComparedPair& pair = pairs[k];
    const double expected = factor * pair.simulated;
    PairUse& use = fit.uses.emplace_back(PairUse::uncertain);
    if (!is_clear(pair) || expected < noise.limit(pair)) continue;
    use = pair.measured > 0 ? PairUse::fitted : PairUse::measured_zero;
    if (use != PairUse::fitted) continue;
    fit.fitted.push_back(k);
    ratios.push_back(decibel(pair.measured / pair.simulated));
    // Errors relative to the expected signal, not the measured one: weights must not depend on the noise.
    errors.push_back(db_per_e *
                     std::hypot(pair.error.value_or(0) / expected, pair.standard_error / pair.simulated));
  }
  const auto silent = std::count(fit.uses.begin(), fit.uses.end(), PairUse::measured_zero);
  const bool all_silent =
      std::all_of(pairs.begin(), pairs.end(), [](const ComparedPair& pair) { return pair.measured <= 0; });
  if (all_silent || static_cast<std::size_t>(silent) > fit.fitted.size())
    throw InputError(name, "has values of 0 or less for most of the strong signals, so no factor fits",
                     "signals must be linear (not decibels) and positive; check ids and unit of measure");
  if (fit.fitted.size() < 3)
    throw InputError(name,
                     fmt::format("has {} clear enough to be fitted, out of {}",
                                 counted(fit.fitted.size(), "signal"), grouped(pairs.size())),
                     "measure more and stronger signals (at least three), or simulate longer");
  fit.mean = robust_mean(ratios, errors);
  return fit;
}

/// The half width of an interval and its cause.
struct HalfWidth {
  double half_width = 0;
  SharedErrors shared = SharedErrors::none;

  /// Widens the interval if this error requires it.
  void widen(double standard_error, double degrees_of_freedom, double confidence, SharedErrors by) {
    const double wider = -student_quantile((1 - confidence) / 2, degrees_of_freedom) * standard_error;
    if (wider > half_width) *this = {wider, by};
  }
};

/// The half width of the interval of a mean with these influences: the maximum over independent errors and
/// errors shared by the pairs of a label, of a transceiver, or of both (Cameron, Gelbach, Miller 2011).
HalfWidth interval_half_width(std::span<const ComparedPair> pairs, std::span<const std::size_t> fitted,
                              std::span<const double> influences, double effective_count, double confidence) {
  std::vector<std::uint32_t> labels, transceivers;
  for (const std::size_t k : fitted) {
    labels.push_back(pairs[k].label);
    transceivers.push_back(pairs[k].transceiver.value_or(0));
  }
  HalfWidth widest;
  const GroupedError plain = grouped_error(influences, all_numbers(fitted.size()));
  // Unequal weights reduce the effective number of pairs.
  const auto n = static_cast<double>(fitted.size());
  const double count = std::max(effective_count, 1.5);
  widest.widen(plain.standard_error * std::sqrt((n - 1) / n * count / (count - 1)), count - 1, confidence,
               SharedErrors::none);
  const GroupedError of_labels = grouped_error(influences, labels);
  const GroupedError of_units = grouped_error(influences, transceivers);
  const auto groups = [&](const GroupedError& error) {
    return error.groups > 1 && error.groups < fitted.size();
  };
  const auto freedom = [](const GroupedError& error) { return static_cast<double>(error.groups) - 1; };
  if (groups(of_labels))
    widest.widen(of_labels.standard_error, freedom(of_labels), confidence, SharedErrors::of_labels);
  if (groups(of_units))
    widest.widen(of_units.standard_error, freedom(of_units), confidence, SharedErrors::of_transceivers);
  const auto square = [](const GroupedError& error) { return error.standard_error * error.standard_error; };
  if (groups(of_labels) && groups(of_units))
    widest.widen(std::sqrt(std::max(0.0, square(of_labels) + square(of_units) - square(plain))),
                 std::min(freedom(of_labels), freedom(of_units)), confidence, SharedErrors::of_both);
  return widest;
}

/// Slope of log measured over log simulated, corrected for the errors of the simulation, which would flatten
/// it (Fuller 1987).
void fit_slope(Comparison& result, std::span<const ComparedPair> pairs, std::span<const std::size_t> fitted,
               const RobustMean& mean) {
  std::vector<double> x;
  double total = 0, centre = 0;
  for (std::size_t k = 0; k < fitted.size(); ++k) {
    x.push_back(decibel(pairs[fitted[k]].simulated));
    total += mean.weights[k];
    centre += mean.weights[k] * x.back();
  }
  centre /= total;
  double squares = 0, products = 0;
  for (std::size_t k = 0; k < fitted.size(); ++k) {
    const ComparedPair& pair = pairs[fitted[k]];
    const double error = db_per_e * pair.standard_error / pair.simulated;
    const double offset = x[k] - centre;
    squares += mean.weights[k] * (offset * offset - error * error);
    products += mean.weights[k] * (offset * *result.pairs[fitted[k]].residual + error * error);
  }
  if (!(squares > 0.25 * total)) return;  // x varies by less than half a decibel
  const double tilt = products / squares;
  std::vector<double> influences;
  for (std::size_t k = 0; k < fitted.size(); ++k)
    influences.push_back(mean.weights[k] * (x[k] - centre) *
                         (*result.pairs[fitted[k]].residual - tilt * (x[k] - centre)) / squares);
  const double half_width = interval_half_width(pairs, fitted, influences,
                                                std::max(2.0, mean.effective_count - 1), result.confidence)
                                .half_width;
  result.slope = 1 + tilt;
  result.slope_interval = {1 + tilt - half_width, 1 + tilt + half_width};
}

double correlation(std::span<const ComparedPair> pairs, std::span<const std::size_t> fitted) {
  double x_mean = 0, y_mean = 0;
  const auto n = static_cast<double>(fitted.size());
  for (const std::size_t k : fitted) {
    x_mean += decibel(pairs[k].simulated) / n;
    y_mean += decibel(pairs[k].measured) / n;
  }
  double xx = 0, yy = 0, xy = 0;
  for (const std::size_t k : fitted) {
    const double x = decibel(pairs[k].simulated) - x_mean, y = decibel(pairs[k].measured) - y_mean;
    xx += x * x;
    yy += y * y;
    xy += x * y;
  }
  return xx > 0 && yy > 0 ? xy / std::sqrt(xx * yy) : 0;
}

double chi_square(std::span<const ComparedPair> pairs, double factor) {
  double sum = 0;
  for (const ComparedPair& pair : pairs) {
    const double z =
        (pair.measured - factor * pair.simulated) / std::hypot(*pair.error, factor * pair.standard_error);
    sum += z * z;
  }
  return sum;
}

/// The minimum chi-square over all factors within 3 dB of the fitted factor. If the minimum lies outside, the
/// pairs have outliers that reject a single factor anyway.
OneFactorTest one_factor_test(std::span<const ComparedPair> pairs, double factor) {
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double low = std::log(factor / 2), high = std::log(factor * 2);
  for (int step = 0; step < 60; ++step) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    if (chi_square(pairs, std::exp(a)) < chi_square(pairs, std::exp(b)))
      high = b;
    else
      low = a;
  }
  OneFactorTest test;
  test.statistic = chi_square(pairs, std::exp((low + high) / 2));
  test.degrees_of_freedom = static_cast<double>(pairs.size() - 1);
  test.p_value = chi_square_upper_tail(test.statistic, test.degrees_of_freedom);
  return test;
}

/// The deviation of a pair in standard deviations, for pairs without a meaningful residual in dB.
double linear_deviation(const ComparedPair& pair, const Comparison& result, const NoiseFloor& noise) {
  const double expected = result.factor * pair.simulated;
  const double error = pair.error ? *pair.error : noise.max_noise(pair);
  const double deviation =
      std::hypot(std::hypot(error, result.factor * pair.standard_error), result.spread / db_per_e * expected);
  return deviation > 0 ? (pair.measured - expected) / deviation : 0;
}

/// The minimum deviation of a pair that was measured as 0, in standard deviations.
double silent_deviation(const ComparedPair& pair, const PairResult& of_pair, const Comparison& result,
                        const NoiseFloor& noise) {
  const double bound = decibel(noise.max_noise(pair) / of_pair.expected);  // -inf without any limit
  const double deviation = std::hypot(result.spread, db_per_e * pair.standard_error / pair.simulated);
  if (bound >= 0) return 0;
  return deviation > 0 ? bound / deviation : -std::numeric_limits<double>::infinity();
}

void judge_pairs(Comparison& result, std::span<const ComparedPair> pairs, std::span<const std::size_t> fitted,
                 const RobustMean& mean, const NoiseFloor& noise) {
  for (std::size_t k = 0; k < fitted.size(); ++k) {
    PairResult& of_pair = result.pairs[fitted[k]];
    of_pair.standardized = *of_pair.residual / mean.deviations[k];
  }
  const double level = sidak_level(outlier_level, static_cast<double>(pairs.size()));
  const double limit = -student_quantile(level / 2, static_cast<double>(fitted.size() - 1));
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    PairResult& of_pair = result.pairs[k];
    if (of_pair.use == PairUse::uncertain)
      of_pair.standardized = linear_deviation(pairs[k], result, noise);
    else if (of_pair.use == PairUse::measured_zero)
      of_pair.standardized = silent_deviation(pairs[k], of_pair, result, noise);
    of_pair.outlier = std::abs(of_pair.standardized) > limit;
    if (of_pair.outlier) result.outliers.push_back(k);
  }
  const auto by_size = [&](auto size) {
    return [&result, size](std::size_t a, std::size_t b) {
      return size(result.pairs[a]) > size(result.pairs[b]);
    };
  };
  std::stable_sort(result.outliers.begin(), result.outliers.end(),
                   by_size([](const PairResult& pair) { return std::abs(pair.standardized); }));
  for (const std::size_t k : fitted)
    if (!result.pairs[k].outlier) result.worst.push_back(k);
  std::stable_sort(result.worst.begin(), result.worst.end(),
                   by_size([](const PairResult& pair) { return std::abs(*pair.residual); }));
}

void summarize(Comparison& result, std::span<const ComparedPair> pairs, std::span<const std::size_t> fitted) {
  std::vector<double> sizes;
  std::map<std::uint32_t, std::vector<double>> by_transceiver;
  for (const std::size_t k : fitted) {
    sizes.push_back(std::abs(*result.pairs[k].residual));
    if (pairs[k].transceiver) by_transceiver[*pairs[k].transceiver].push_back(*result.pairs[k].residual);
  }
  result.median_residual = quantile(sizes, 0.5);
  result.residual_quantile_90 = quantile(sizes, 0.9);
  result.correlation = correlation(pairs, fitted);
  for (const auto& [column, residuals] : by_transceiver)
    result.transceivers.push_back({column, residuals.size(), quantile(residuals, 0.5)});
}

}  // namespace

std::vector<ComparedPair> compared_pairs(const SignalMatrix& matrix, const Measurements& measurements,
                                         std::span<const ColumnId> units) {
  std::vector<ComparedPair> pairs;
  for (const Measurement& one : measurements.values) {
    ComparedPair pair{one.label, one.transceiver, one.signal, one.error};
    const auto add = [&](std::uint32_t column) {
      pair.simulated += static_cast<double>(matrix.mean[matrix.at(one.label, column)]);
      // The entries of a row share paths; the sum of errors is an upper limit for any correlation.
      pair.standard_error += static_cast<double>(matrix.standard_error[matrix.at(one.label, column)]);
    };
    if (one.transceiver)
      add(*one.transceiver);
    else
      for (const std::uint32_t column : units) add(column);
    if (const double freedom = matrix.labels[one.label].batches - 1.0; freedom > 2)
      pair.standard_error *= std::sqrt(freedom / (freedom - 2));
    pairs.push_back(pair);
  }
  return pairs;
}

Comparison compare_signals(std::span<const ComparedPair> pairs, double confidence, const std::string& name) {
  const NoiseFloor noise(pairs);
  // The set of clear pairs depends slightly on the factor, so the fit is repeated from the first result.
  Fit fit = fit_from(first_factor(pairs, noise), pairs, noise, name);
  fit = fit_from(factor_of(fit.mean), pairs, noise, name);
  const auto& [uses, fitted, mean] = fit;
  const HalfWidth half =
      interval_half_width(pairs, fitted, mean.influences, mean.effective_count, confidence);
  Comparison result;
  result.confidence = confidence;
  result.fitted = fitted.size();
  result.factor = factor_of(mean);
  result.factor_interval = {std::pow(10, (mean.value - half.half_width) / 10),
                            std::pow(10, (mean.value + half.half_width) / 10)};
  result.shared = half.shared;
  result.spread = mean.spread;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    PairResult& of_pair = result.pairs.emplace_back();
    of_pair.use = uses[k];
    of_pair.expected = result.factor * pairs[k].simulated;
    if (pairs[k].measured > 0 && pairs[k].simulated > 0)
      of_pair.residual = decibel(pairs[k].measured / pairs[k].simulated) - mean.value;
  }
  result.uncertain = static_cast<std::size_t>(std::count(uses.begin(), uses.end(), PairUse::uncertain));
  result.measured_zero = pairs.size() - result.fitted - result.uncertain;
  judge_pairs(result, pairs, fitted, mean, noise);
  summarize(result, pairs, fitted);
  fit_slope(result, pairs, fitted, mean);
  if (std::all_of(pairs.begin(), pairs.end(),
                  [](const ComparedPair& pair) { return pair.error.has_value(); }))
    result.test = one_factor_test(pairs, result.factor);
  return result;
}

}  // namespace shelfbeam
