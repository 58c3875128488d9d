#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/stats/log_histogram.hpp"
#include "shelfbeam/transport/run/simulation_summary.hpp"
#include "shelfbeam/transport/run/stopping.hpp"
#include "shelfbeam/transport/tally/estimator.hpp"
#include "shelfbeam/transport/tally/item_sums.hpp"
#include "shelfbeam/transport/tally/known_light.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam::detail {

/// Looks at the errors that the items have so far.
class ErrorSurvey {
 public:
  ErrorSurvey(const World& world, const Estimator& estimator, const std::vector<ItemSums>& sums,
              const KnownLight& known)
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
  const KnownLight& known_;
};

}  // namespace shelfbeam::detail
