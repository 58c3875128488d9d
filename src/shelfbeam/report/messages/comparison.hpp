#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/report/text/words.hpp"
#include "shelfbeam/signal/measured/comparison.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam {

/// The result of a comparison, one or two sentences each; the factor comes first.
std::vector<std::string> comparison_statements(const Words& words, const Comparison& comparison);

/// The heading of the list Comparison::worst, which does not contain outliers.
std::string_view worst_pairs_heading(const Words& words, const Comparison& comparison);

/// "A1-front-0-3 from G0-3-2"; the label alone where several units were measured at once.
std::string pair_name(const Words& words, const SignalMatrix& matrix, const ComparedPair& pair);

}  // namespace shelfbeam
