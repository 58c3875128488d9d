#include "shelfbeam/report/messages/comparison.hpp"

#include <cstdint>

#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/text/catalogue.hpp"

namespace shelfbeam {

namespace {

std::string_view shared_errors(SharedErrors shared) {
  switch (shared) {
    case SharedErrors::none:
      return {};
    case SharedErrors::of_labels:
      return words("comparison.shared.labels");
    case SharedErrors::of_transceivers:
      return words("comparison.shared.transceivers");
    case SharedErrors::of_both:
      return words("comparison.shared.both");
  }
  return {};
}

std::string factor_statement(const Comparison& c) {
  return say("comparison.factor", significant(c.factor, 4), confidence_text(c.confidence),
             significant(c.factor_interval.low, 4), significant(c.factor_interval.high, 4),
             shared_errors(c.shared));
}

std::string agreement_statement(const Comparison& c) {
  const std::string spread =
      c.spread > 0 ? say("comparison.spread.some", fixed(c.spread, 2)) : say("comparison.spread.none");
  return say_count("comparison.agreement", c.fitted, fixed(c.median_residual, 2),
                   fixed(c.residual_quantile_90, 2), spread);
}

std::string test_statement(const Comparison& c) {
  if (!c.test) return say("comparison.test.missing");
  const std::string p =
      c.test->p_value < 1e-4 ? say("comparison.test.tiny") : significant(c.test->p_value, 2);
  const std::string figures = say("comparison.test.figures", significant(c.test->statistic, 4),
                                  grouped(static_cast<std::uint64_t>(c.test->degrees_of_freedom)), p);
  return say(c.test->rejected() ? "comparison.test.rejected" : "comparison.test.passed", figures);
}

std::string slope_statement(const Comparison& c) {
  if (!c.slope) return say("comparison.slope.missing");
  const std::string figures =
      say("comparison.slope.figures", fixed(*c.slope, 3), fixed(c.slope_interval.low, 3),
          fixed(c.slope_interval.high, 3), fixed(c.correlation, 3));
  return say(c.slope_interval.holds(1) ? "comparison.slope.same" : "comparison.slope.different", figures);
}

std::string not_fitted_statement(const Comparison& c) {
  std::string text;
  if (c.uncertain > 0) text = say_count("comparison.uncertain", c.uncertain);
  if (c.measured_zero > 0)
    text += (text.empty() ? "" : " ") + say_count("comparison.nothing_measured", c.measured_zero);
  return text;
}

}  // namespace

std::string_view worst_pairs_heading(const Comparison& comparison) {
  return words(comparison.outliers.empty() ? "comparison.worst.title"
                                           : "comparison.worst.title_without_outliers");
}

std::string pair_name(const SignalMatrix& matrix, const ComparedPair& pair) {
  const std::string& label = matrix.labels[pair.label].id;
  return pair.transceiver ? say("comparison.pair", label, matrix.transceivers[*pair.transceiver].id) : label;
}

std::vector<std::string> comparison_statements(const Comparison& c) {
  std::vector<std::string> statements{factor_statement(c), agreement_statement(c), test_statement(c),
                                      slope_statement(c)};
  if (std::string omitted = not_fitted_statement(c); !omitted.empty()) statements.push_back(omitted);
  return statements;
}

}  // namespace shelfbeam
