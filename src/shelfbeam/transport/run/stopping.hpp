#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "shelfbeam/transport/run/simulation_options.hpp"

namespace shelfbeam {

/// Before so many batches no entry is said to be out of reach of a relative error,
inline constexpr std::uint32_t judged_batches = 4 * least_batches;
/// and from so many on, one is that is still flagged.
inline constexpr std::uint32_t last_flagged_batches = 64 * least_batches;

/// Whether a simulation may stop by its errors after so many batches: first after `least_batches`, then
/// whenever they have grown by a sixteenth. Looking less often than after every batch costs little, and gives
/// chance fewer occasions to stop too early.
bool is_stopping_point(std::uint32_t batches);

/// How many entries matter, how many of these are precise enough, and how many others cannot become so.
struct Precision {
  std::uint64_t relevant = 0, precise = 0, hopeless = 0;

  bool is_enough() const { return 100 * precise >= 99 * relevant; }
  bool is_hopeless() const { return 100 * hopeless > relevant; }
  bool is_decided() const { return precise + hopeless == relevant; }
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

/// What more samples can still bring.
struct Reachable {
  double error = std::numeric_limits<double>::infinity();  ///< so many times what is wanted: reachable_error
  bool flags_are_final = false;                            ///< from `last_flagged_batches` on
};

/// How an entry that matters stands to the error that is wanted; flagged ones (SignalMatrix::flags) are not
/// precise.
enum class Standing { precise, open, hopeless };
Standing standing(double mean, double standard_error, bool is_flagged, const RelativeError& wanted,
                  const Reachable& reachable);

/// Counts the entries of a row, from their means and standard errors.
Precision count_precise(std::span<const double> means, std::span<const double> standard_errors,
                        std::span<const std::uint8_t> flags, double requirement, const RelativeError& wanted,
                        const Reachable& reachable = {});

/// How many times too large an error may be after so many batches and still fall to what is wanted with
/// `growth` times as many: sqrt(growth), and what an error that batches estimate is off by at most, three
/// times 1 / sqrt(2 (batches - 1)).
double reachable_error(std::uint32_t batches, double growth);

}  // namespace shelfbeam
