#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/stats/log_histogram.hpp"
#include "shelfbeam/transport/detail/item_sums.hpp"
#include "shelfbeam/transport/detail/known_light.hpp"
#include "shelfbeam/transport/estimator.hpp"
#include "shelfbeam/transport/simulation_summary.hpp"
#include "shelfbeam/transport/stopping.hpp"
#include "shelfbeam/transport/world.hpp"

namespace shelfbeam::detail {

/// Looks at the errors that the items have so far.
class ErrorSurvey {
 public:
  ErrorSurvey(const World& world, const Estimator& estimator, const std::vector<ItemSums>& sums,
              const KnownLight& known)
      : world_(world), estimator_(estimator), sums_(sums), known_(known) {}

  Precision precision(std::size_t item, const RelativeError& wanted) const;

  /// The entries that matter and are not precise enough.
  struct Shortfall {
    std::uint64_t relevant = 0, entries = 0;  ///< that matter; of these, that fall short
    std::uint64_t out_of_reach = 0;           ///< of these, that more samples would not help
    std::vector<UnmetEntry> worst;            ///< these first, the largest error first

    bool is_small_enough() const { return Precision{relevant, relevant - entries}.is_enough(); }
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
  /// How many times too large an item's errors may be and still be brought down (reachable_error).
  double reachable(std::size_t item, const RelativeError& wanted) const;
  template <class Use>
  void each_row(std::size_t item, Use use) const;

  const World& world_;
  const Estimator& estimator_;
  const std::vector<ItemSums>& sums_;
  const KnownLight& known_;
};

}  // namespace shelfbeam::detail
