#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/report/data/outcome.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam {

/// Counts between `edges` and beyond them; a value on an edge counts in the bin to its right.
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

/// All entries of M (Fig. 3.7): `bins_per_decade` bins per decade, at most `signal_decades` decades down from
/// the largest entry. Smaller entries count as `below`; zeros and entries that are negative from noise as
/// `zeros`.
inline constexpr int bins_per_decade = 5;
inline constexpr int signal_decades = 8;
struct SignalDistribution {
  Bins signal;  ///< W/m^2
  std::uint64_t zeros = 0, entries = 0;
};
SignalDistribution signal_distribution(const SignalMatrix& matrix);

/// The error summary covers entries of at least this share of the label's requirement: smaller entries hardly
/// affect whether a label is reached.
inline constexpr double relevant_share = 0.3;

/// The precision of a matrix. Relative standard errors apply to single entries: the entries of one label
/// share its paths and are correlated, so sums may have other errors.
struct SamplingSummary {
  std::size_t entries = 0;
  std::size_t zeros = 0;     ///< entries without any signal
  std::size_t relevant = 0;  ///< entries of at least relevant_share of the requirement
  std::size_t flagged = 0;   ///< relevant entries whose error is not reliable
  bool has_errors = false;   ///< the matrix contains standard errors
  bool has_flags = false;    ///< the matrix flags errors that are not reliable
  double mean = 0, median = 0, p90 = 0, p99 = 0, worst = 0;  ///< relative standard error of relevant entries
  std::uint64_t min_samples = 0, max_samples = 0;            ///< per label
  std::uint32_t min_batches = 0, max_batches = 0;
};

SamplingSummary sampling_summary(const SignalMatrix& matrix);

/// The number of labels whose signal lies within two standard errors of their requirement, so that other
/// samples could change the verdict. The error of a sum is that of its largest entry, so this is a lower
/// estimate.
std::size_t uncertain_labels(const SignalMatrix& matrix, const Outcome& outcome);

}  // namespace shelfbeam
