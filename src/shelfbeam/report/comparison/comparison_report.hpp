#pragma once

#include <span>
#include <string>

#include "shelfbeam/report/text/words.hpp"
#include "shelfbeam/signal/measured/comparison.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam {

/// The input of a comparison report.
struct ComparisonInput {
  const SignalMatrix& matrix;
  std::span<const ComparedPair> pairs;
  const Comparison& comparison;
  std::string measured_name, simulated_name;  ///< file names
  bool safe_csv = false;                      ///< as in ReportInput
};

/// comparison.csv (docs/formats/measurements.md): one row per pair, in the order of the measurements.
std::string comparison_csv(const ComparisonInput& input);

/// A self-contained page: the answer, the signals on two logarithmic axes, the residuals, the worst pairs.
std::string comparison_html(const Words& words, const ComparisonInput& input);

}  // namespace shelfbeam
