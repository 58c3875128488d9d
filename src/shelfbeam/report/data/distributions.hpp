#pragma once

#include <cstddef>
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

/// Entries count for the error summary from this share of the label's requirement on: smaller ones hardly
/// decide whether a label is met.
inline constexpr double relevant_share = 0.3;

/// How well a matrix is known. Relative standard errors are of single entries: those of one label share its
/// paths and are correlated, so nothing is said about sums.
struct SamplingSummary {
  std::size_t entries = 0;
  std::size_t zeros = 0;     ///< entries without any signal
  std::size_t relevant = 0;  ///< entries of at least relevant_share of the requirement
  std::size_t flagged = 0;   ///< of the relevant ones: their error is not to be trusted
  bool has_errors = false;   ///< the matrix carries standard errors
  bool has_flags = false;    ///< and tells which of them are not to be trusted
  double mean = 0, median = 0, p90 = 0, p99 = 0, worst = 0;  ///< relative standard error of relevant entries
  std::uint64_t least_samples = 0, most_samples = 0;         ///< first rays a label
  std::uint32_t least_batches = 0, most_batches = 0;
};

SamplingSummary sampling_summary(const SignalMatrix& matrix);

/// Labels whose signal lies within two standard errors of their requirement, so that other samples could turn
/// the verdict. Of a sum only the error of its largest entry is known: rather too few than too many.
std::size_t uncertain_labels(const SignalMatrix& matrix, const Outcome& outcome);

}  // namespace shelfbeam
