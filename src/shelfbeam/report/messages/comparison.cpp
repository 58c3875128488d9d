#include "shelfbeam/report/messages/comparison.hpp"

#include <fmt/format.h>

#include "shelfbeam/report/data/text_format.hpp"

namespace shelfbeam {

namespace {

std::string factor_statement(const Comparison& c) {
  constexpr const char* shared[] = {
      "", ", allowing for errors that all signals of a label share",
      ", allowing for errors that all signals of a transceiver share",
      ", allowing for errors that all signals of a label or of a transceiver share"};
  return fmt::format(
      "Measured signals are {} times the simulated signals (W/m² for the cosine response); {}\u00A0% "
      "confidence interval {} to {}{}.",
      significant(c.factor, 4), plain(100 * c.confidence), significant(c.factor_interval.low, 4),
      significant(c.factor_interval.high, 4), shared[static_cast<std::size_t>(c.shared)]);
}

std::string test_statement(const Comparison& c) {
  if (!c.test)
    return "No measurement errors are given, so it cannot be tested whether one factor explains all "
           "differences.";
  const std::string figures =
      fmt::format("chi-square {} with {} degrees of freedom, p {}", significant(c.test->statistic, 4),
                  grouped(static_cast<std::uint64_t>(c.test->degrees_of_freedom)),
                  c.test->p_value < 1e-4 ? "below 0.0001" : significant(c.test->p_value, 2));
  return c.test->rejected()
             ? fmt::format("One factor and the known errors do not explain the differences ({}).", figures)
             : fmt::format("One factor and the known errors explain the differences ({}).", figures);
}

std::string slope_statement(const Comparison& c) {
  if (!c.slope) return "The signals vary too little to compare the growth of measured and simulated signals.";
  const std::string figures =
      fmt::format("slope {}, interval {} to {}; correlation {}", fixed(*c.slope, 3),
                  fixed(c.slope_interval.low, 3), fixed(c.slope_interval.high, 3), fixed(c.correlation, 3));
  return c.slope_interval.holds(1)
             ? fmt::format("Measured and simulated signals grow at the same rate in decibels ({}).", figures)
             : fmt::format(
                   "Measured and simulated signals grow at different rates in decibels; no factor corrects "
                   "this difference ({}).",
                   figures);
}

std::string not_fitted_statement(const Comparison& c) {
  std::string text;
  if (c.uncertain > 0)
    text = fmt::format("{} not fitted: too faint compared with the errors. ",
                       counted(c.uncertain, "pair was", "pairs were"));
  if (c.measured_zero > 0)
    text += fmt::format("{} a measured signal of 0 or less where a clear signal is expected. ",
                        counted(c.measured_zero, "pair has", "pairs have"));
  if (!text.empty()) text.pop_back();
  return text;
}

}  // namespace

std::string_view worst_pairs_heading(const Comparison& comparison) {
  return comparison.outliers.empty() ? "Fitted pairs with the largest residuals"
                                     : "Fitted pairs with the largest residuals, without outliers";
}

std::string pair_name(const SignalMatrix& matrix, const ComparedPair& pair) {
  const std::string& label = matrix.labels[pair.label].id;
  return pair.transceiver ? fmt::format("{} from {}", label, matrix.transceivers[*pair.transceiver].id)
                          : label;
}

std::vector<std::string> comparison_statements(const Comparison& c) {
  std::vector<std::string> statements{
      factor_statement(c),
      fmt::format("Half of the {} within {}\u00A0dB of this factor, 90\u00A0% within {}\u00A0dB; {}.",
                  counted(c.fitted, "fitted pair is", "fitted pairs are"), fixed(c.median_residual, 2),
                  fixed(c.residual_quantile_90, 2),
                  c.spread > 0 ? fmt::format("the known errors leave a spread of {}\u00A0dB unexplained",
                                             fixed(c.spread, 2))
                               : "the known errors leave no spread unexplained"),
      test_statement(c), slope_statement(c)};
  if (std::string omitted = not_fitted_statement(c); !omitted.empty()) statements.push_back(omitted);
  return statements;
}

}  // namespace shelfbeam
