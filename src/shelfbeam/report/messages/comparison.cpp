#include "shelfbeam/report/messages/comparison.hpp"

#include <cstdint>

#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

std::string_view shared_errors(const Words& words, SharedErrors shared) {
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

std::string factor_statement(const Words& words, const Comparison& c) {
  return words.say("comparison.factor", words.significant(c.factor, 4), words.confidence_text(c.confidence),
                   words.significant(c.factor_interval.low, 4), words.significant(c.factor_interval.high, 4),
                   shared_errors(words, c.shared));
}

std::string agreement_statement(const Words& words, const Comparison& c) {
  const std::string spread = c.spread > 0 ? words.say("comparison.spread.some", words.fixed(c.spread, 2))
                                          : words.say("comparison.spread.none");
  return words.say_count("comparison.agreement", c.fitted, words.fixed(c.median_residual, 2),
                         words.fixed(c.residual_quantile_90, 2), spread);
}

std::string test_statement(const Words& words, const Comparison& c) {
  if (!c.test) return words.say("comparison.test.missing");
  const std::string p =
      c.test->p_value < 1e-4 ? words.say("comparison.test.tiny") : words.significant(c.test->p_value, 2);
  const std::string figures =
      words.say("comparison.test.figures", words.significant(c.test->statistic, 4),
                words.grouped(static_cast<std::uint64_t>(c.test->degrees_of_freedom)), p);
  return words.say(c.test->rejected() ? "comparison.test.rejected" : "comparison.test.passed", figures);
}

std::string slope_statement(const Words& words, const Comparison& c) {
  if (!c.slope) return words.say("comparison.slope.missing");
  const std::string figures =
      words.say("comparison.slope.figures", words.fixed(*c.slope, 3), words.fixed(c.slope_interval.low, 3),
                words.fixed(c.slope_interval.high, 3), words.fixed(c.correlation, 3));
  return words.say(c.slope_interval.holds(1) ? "comparison.slope.same" : "comparison.slope.different",
                   figures);
}

std::string not_fitted_statement(const Words& words, const Comparison& c) {
  std::string text;
  if (c.uncertain > 0) text = words.say_count("comparison.uncertain", c.uncertain);
  if (c.measured_zero > 0)
    text += (text.empty() ? "" : " ") + words.say_count("comparison.nothing_measured", c.measured_zero);
  return text;
}

}  // namespace

std::string_view worst_pairs_heading(const Words& words, const Comparison& comparison) {
  return words(comparison.outliers.empty() ? "comparison.worst.title"
                                           : "comparison.worst.title_without_outliers");
}

std::string pair_name(const Words& words, const SignalMatrix& matrix, const ComparedPair& pair) {
  const std::string& label = matrix.labels[pair.label].id;
  return pair.transceiver ? words.say("comparison.pair", label, matrix.transceivers[*pair.transceiver].id)
                          : label;
}

std::vector<std::string> comparison_statements(const Words& words, const Comparison& c) {
  std::vector<std::string> statements{factor_statement(words, c), agreement_statement(words, c),
                                      test_statement(words, c), slope_statement(words, c)};
  if (std::string omitted = not_fitted_statement(words, c); !omitted.empty()) statements.push_back(omitted);
  return statements;
}

}  // namespace shelfbeam
