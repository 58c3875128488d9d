#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "shelfbeam/stats/log_histogram.hpp"
#include "shelfbeam/transport/run/simulation_options.hpp"
#include "shelfbeam/transport/run/simulation_summary.hpp"
#include "shelfbeam/transport/tally/analytic_direct.hpp"
#include "shelfbeam/transport/tally/estimator.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam {

/// Minimum number of batches before a relative error may be called out of reach.
inline constexpr std::uint32_t judged_batches = 4 * min_batches;
/// Number of batches from which the error of an entry that is still flagged is out of reach.
inline constexpr std::uint32_t last_flagged_batches = 64 * min_batches;

/// Whether a simulation may stop by its errors after this number of batches: first after `min_batches`, then
/// whenever the number has grown by a sixteenth. Checks after every batch would give chance more occasions to
/// stop too early.
bool is_stopping_point(std::uint32_t batches);

/// Number of entries that matter, of those that are precise enough, and of those that cannot become so.
struct Precision {
  std::uint64_t relevant = 0, precise = 0, unreachable = 0;

  bool is_enough() const { return 100 * precise >= 99 * relevant; }
  bool is_hopeless() const { return 100 * unreachable > relevant; }
  bool is_decided() const { return precise + unreachable == relevant; }
  Precision& operator+=(const Precision& other) {
    relevant += other.relevant;
    precise += other.precise;
    unreachable += other.unreachable;
    return *this;
  }
};

/// The limit above which the mean of an entry matters: a share of the label's requirement or, if this is 0,
/// of the largest mean of its row.
double relevance_limit(std::span<const double> means, double requirement, double share);

/// The improvement that more samples can still give.
struct Reachable {
  double error = std::numeric_limits<double>::infinity();  ///< reachable_error, over the required error
  bool flags_are_final = false;                            ///< from `last_flagged_batches` on
};

/// Status of an entry that matters: its error is within the required error, may still fall to it, or cannot.
/// Flagged entries (SignalMatrix::flags) are not precise.
enum class EntryStatus { precise, open, unreachable };
EntryStatus entry_status(double mean, double standard_error, bool is_flagged, const RelativeError& wanted,
                         const Reachable& reachable);

/// Counts the entries of a row, from their means and standard errors.
Precision count_precise(std::span<const double> means, std::span<const double> standard_errors,
                        std::span<const std::uint8_t> flags, double requirement, const RelativeError& wanted,
                        const Reachable& reachable = {});

/// The factor by which an error may exceed the required error after `batches` batches and still fall to it
/// with `growth` times as many: sqrt(growth), times an allowance for the uncertainty of the estimated error,
/// 1 + 3 / sqrt(2 (batches - 1)).
double reachable_error(std::uint32_t batches, double growth);

/// Evaluates the current errors of the items.
class ErrorSurvey {
 public:
  ErrorSurvey(const World& world, const Estimator& estimator, const std::vector<ItemSums>& sums,
              const detail::AnalyticDirect& analytic_direct)
      : world_(world), estimator_(estimator), sums_(sums), analytic_direct_(analytic_direct) {}

  Precision precision(std::size_t item, const RelativeError& wanted) const;

  /// Counts of the entries that matter, and the worst of those that are not precise enough: hopeless entries
  /// first, then by decreasing error.
  struct Shortfall {
    Precision precision;
    std::vector<UnmetEntry> worst;
  };
  /// Lists at most `named` entries.
  Shortfall shortfall(const RelativeError& wanted, std::size_t named) const;

  /// Errors of the entries above a share of their label's requirement.
  struct Errors {
    LogHistogram relative;      ///< relative standard errors
    std::uint64_t flagged = 0;  ///< number of flagged entries
  };
  /// Errors of all items with at least two batches, on the threads of the current arena.
  Errors errors(double above) const;

 private:
  double requirement(std::size_t i) const;
  Reachable reachable(std::size_t item, const RelativeError& wanted) const;
  template <class Use>
  void each_row(std::size_t item, Use use) const;

  const World& world_;
  const Estimator& estimator_;
  const std::vector<ItemSums>& sums_;
  const detail::AnalyticDirect& analytic_direct_;
};

}  // namespace shelfbeam
