#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "shelfbeam/stats/log_histogram.hpp"
#include "shelfbeam/transport/run/simulation_options.hpp"
#include "shelfbeam/transport/run/simulation_summary.hpp"
#include "shelfbeam/transport/tally/estimator.hpp"
#include "shelfbeam/transport/tally/known_light.hpp"
#include "shelfbeam/transport/world/world.hpp"

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

/// Looks at the errors that the items have so far.
class ErrorSurvey {
 public:
  ErrorSurvey(const World& world, const Estimator& estimator, const std::vector<ItemSums>& sums,
              const detail::KnownLight& known)
      : world_(world), estimator_(estimator), sums_(sums), known_(known) {}

  Precision precision(std::size_t item, const RelativeError& wanted) const;

  /// The entries that matter, and those of them that are not precise enough: hopeless ones first, the largest
  /// error first.
  struct Shortfall {
    Precision precision;
    std::vector<UnmetEntry> worst;
  };
  /// Names so many of them at most.
  Shortfall shortfall(const RelativeError& wanted, std::size_t named) const;

  /// The entries above a share of their label's requirement.
  struct Errors {
    LogHistogram relative;      ///< their relative standard errors
    std::uint64_t flagged = 0;  ///< so many of them are not to be trusted
  };
  /// Of all items with two batches or more; on the threads of the present arena.
  Errors errors(double above) const;

 private:
  double requirement(std::size_t i) const;
  Reachable reachable(std::size_t item, const RelativeError& wanted) const;
  template <class Use>
  void each_row(std::size_t item, Use use) const;

  const World& world_;
  const Estimator& estimator_;
  const std::vector<ItemSums>& sums_;
  const detail::KnownLight& known_;
};

}  // namespace shelfbeam
