#pragma once

#include <cstdint>
#include <vector>

#include "shelfbeam/report/data/outcome.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam {

/// Counts between `edges` (a value on an edge falls to its right) and beyond them.
struct Bins {
  std::vector<double> edges;
  std::vector<std::uint64_t> counts;  ///< edges.size() - 1
  std::uint64_t below = 0, above = 0;
};

/// Excess signal of every label, 100 (S - gamma tau) / (gamma tau) in percent (Fig. 3.5). Bins of a round
/// width, 0 an edge; the last percent of the labels may lie above the last edge.
struct ExcessDistribution {
  Bins percent;
  double median = 0, mean = 0;
};
ExcessDistribution excess_distribution(const Outcome& outcome);

/// All entries of M (Fig. 3.7): `bins_per_decade` bins a decade, at most `signal_decades` decades down from
/// the largest entry; what is smaller counts as below, zero and what is negative through noise as zeros.
inline constexpr int bins_per_decade = 5;
inline constexpr int signal_decades = 8;
struct SignalDistribution {
  Bins signal;  ///< W/m^2
  std::uint64_t zeros = 0, entries = 0;
};
SignalDistribution signal_distribution(const SignalMatrix& matrix);

}  // namespace shelfbeam
