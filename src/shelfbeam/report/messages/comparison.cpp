#include "shelfbeam/report/messages/comparison.hpp"

#include <fmt/format.h>

#include "shelfbeam/report/data/text_format.hpp"

namespace shelfbeam {

namespace {

std::string factor_statement(const Comparison& c) {
  constexpr const char* shared[] = {
      "", ", which allows for errors that the signals of a label share",
      ", which allows for errors that the signals of a transceiver share",
      ", which allows for errors that the signals of a label or of a transceiver share"};
  return fmt::format(
      "One unit of simulated signal (W/m² for the cosine response) measures {}; {}\u00A0% interval {} to "
      "{}{}.",
      significant(c.factor, 4), plain(100 * c.confidence), significant(c.factor_interval.low, 4),
      significant(c.factor_interval.high, 4), shared[static_cast<std::size_t>(c.shared)]);
}

std::string test_statement(const Comparison& c) {
  if (!c.test)
    return "Whether one factor explains all differences cannot be tested without errors of the measurements.";
  const std::string figures =
      fmt::format("chi-square {} with {} degrees of freedom, p {}", significant(c.test->statistic, 4),
                  grouped(static_cast<std::uint64_t>(c.test->degrees_of_freedom)),
                  c.test->p_value < 1e-4 ? "below 0.0001" : significant(c.test->p_value, 2));
  return c.test->rejected()
             ? fmt::format("One factor and the known errors do not explain the differences ({}).", figures)
             : fmt::format("One factor and the known errors explain the differences ({}).", figures);
}

std::string slope_statement(const Comparison& c) {
  if (!c.slope) return "The signals hardly vary, so nothing can be said of how both grow together.";
  const std::string figures =
      fmt::format("slope {}, interval {} to {}; correlation {}", fixed(*c.slope, 3),
                  fixed(c.slope_interval.low, 3), fixed(c.slope_interval.high, 3), fixed(c.correlation, 3));
  return c.slope_interval.holds(1)
             ? fmt::format("In decibels both grow alike ({}).", figures)
             : fmt::format("In decibels they do not grow alike, which no factor mends ({}).", figures);
}

std::string left_out_statement(const Comparison& c) {
  std::string text;
  if (c.uncertain > 0)
    text = fmt::format("{} not fitted: too faint beside the errors. ",
                       counted(c.uncertain, "pair was", "pairs were"));
  if (c.nothing_measured > 0)
    text += fmt::format("{} 0 or less where a clear signal is expected. ",
                        counted(c.nothing_measured, "pair measured", "pairs measured"));
  if (!text.empty()) text.pop_back();
  return text;
}

}  // namespace

std::string_view worst_pairs(const Comparison& comparison) {
  return comparison.outliers.empty() ? "Fitted pairs that are furthest off"
                                     : "Fitted pairs that are furthest off, outliers aside";
}

std::string pair_name(const SignalMatrix& matrix, const ComparedPair& pair) {
  const std::string& label = matrix.labels[pair.label].id;
  return pair.transceiver ? fmt::format("{} from {}", label, matrix.transceivers[*pair.transceiver].id)
                          : label;
}

std::vector<std::string> comparison_statements(const Comparison& c) {
  std::vector<std::string> statements{
      factor_statement(c),
      fmt::format("Half of the {} within {}\u00A0dB of it, 90\u00A0% within {}\u00A0dB; {}.",
                  counted(c.fitted, "fitted pair is", "fitted pairs are"), fixed(c.median_residual, 2),
                  fixed(c.ninety_residual, 2),
                  c.spread > 0 ? fmt::format("a spread of {}\u00A0dB is more than the known errors tell",
                                             fixed(c.spread, 2))
                               : "the known errors tell as much"),
      test_statement(c), slope_statement(c)};
  if (std::string left_out = left_out_statement(c); !left_out.empty()) statements.push_back(left_out);
  return statements;
}

}  // namespace shelfbeam
