#pragma once

#include <cstdint>
#include <span>

namespace shelfbeam {

/// When a simulation is precise enough: 99 % of the entries that matter have this relative standard error,
/// and one that can be trusted.
struct RelativeError {
  double error = 0.05;
  double above = 0.3;  ///< entries matter whose mean exceeds this share of their label's requirement
};

/// Fewer batches say too little about their spread to stop by it.
inline constexpr std::uint32_t least_batches = 16;

/// Whether a simulation may stop by its errors after so many batches: first after `least_batches`, then
/// whenever they have grown by a sixteenth. Looking less often than after every batch costs little, and gives
/// chance fewer occasions to stop too early.
bool is_stopping_point(std::uint32_t batches);

/// How many entries matter, and how many of these are precise enough.
struct Precision {
  std::uint64_t relevant = 0, precise = 0;

  bool is_enough() const { return 100 * precise >= 99 * relevant; }
  Precision& operator+=(const Precision& other) {
    relevant += other.relevant;
    precise += other.precise;
    return *this;
  }
};

/// What the mean of an entry must exceed to matter: a share of the label's requirement, or where that is 0 of
/// the largest mean of its row.
double relevance_limit(std::span<const double> means, double requirement, double share);

/// Counts the entries of a row, from their means and standard errors; flagged ones (SignalMatrix::flags) are
/// not precise.
Precision count_precise(std::span<const double> means, std::span<const double> standard_errors,
                        std::span<const std::uint8_t> flags, double requirement, const RelativeError& wanted);

}  // namespace shelfbeam
