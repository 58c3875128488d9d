#pragma once

#include <cstdint>
#include <limits>
#include <span>

namespace shelfbeam {

/// When a simulation is precise enough: 99 % of the entries that matter have this relative standard error,
/// and one that can be trusted.
struct RelativeError {
  double error = 0.05;
  double above = 0.3;  ///< entries matter whose mean exceeds this share of their label's requirement
  /// First rays a label. Labels with entries that would need more are given up after `judged_batches`.
  std::uint64_t most_samples = 4'000'000;
};

/// Fewer batches say too little about their spread to stop by it.
inline constexpr std::uint32_t least_batches = 16;
/// Nor to tell that the error wanted is out of reach.
inline constexpr std::uint32_t judged_batches = 4 * least_batches;

/// Whether a simulation may stop by its errors after so many batches: first after `least_batches`, then
/// whenever they have grown by a sixteenth. Looking less often than after every batch costs little, and gives
/// chance fewer occasions to stop too early.
bool is_stopping_point(std::uint32_t batches);

/// How many entries matter, how many of these are precise enough, and how many others cannot become so.
struct Precision {
  std::uint64_t relevant = 0, precise = 0, hopeless = 0;

  bool is_enough() const { return 100 * precise >= 99 * relevant; }
  bool is_hopeless() const { return 100 * hopeless > relevant; }
  Precision& operator+=(const Precision& other) {
    relevant += other.relevant;
    precise += other.precise;
    hopeless += other.hopeless;
    return *this;
  }
};

/// What the mean of an entry must exceed to matter: a share of the label's requirement, or where that is 0 of
/// the largest mean of its row.
double relevance_limit(std::span<const double> means, double requirement, double share);

/// Counts the entries of a row, from their means and standard errors; flagged ones (SignalMatrix::flags) are
/// not precise. Hopeless are those that would not be precise with `growth` times the samples.
Precision count_precise(std::span<const double> means, std::span<const double> standard_errors,
                        std::span<const std::uint8_t> flags, double requirement, const RelativeError& wanted,
                        double growth = std::numeric_limits<double>::infinity());

}  // namespace shelfbeam
