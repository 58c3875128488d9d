#pragma once

#include <cstdint>
#include <optional>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/coverage/label_weights.hpp"
#include "shelfbeam/placement/kernels/active_rows.hpp"
#include "shelfbeam/placement/kernels/search_matrix.hpp"
#include "shelfbeam/placement/problem/effort.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam::detail {

/// The annealing of `anneal`, but of the missed weight beyond the weight that may be missed, on all labels.
class CoverageAnnealing {
 public:
  /// Whether annealing can hold all labels x candidates of the table.
  static bool fits(const Instance& instance);

  /// Precondition: fits. The arguments must outlive the object.
  CoverageAnnealing(const Instance& instance, const LabelWeights& weights);
  CoverageAnnealing(const CoverageAnnealing&) = delete;

  /// A selection with fewer units than `start` that reaches labels of the weight `target`, or with at most as
  /// many if `start` does not; nullopt if none is found.
  std::optional<Selection> for_fewer(double target, const Selection& start, const Effort& effort,
                                     std::uint32_t seed, const RunControl& control) const;
  /// A selection of as many units as `start` that reaches labels of more weight than `reached`; nullopt if
  /// none is found. The count is fixed: whenever a selection reaches more, it must reach still more from then
  /// on.
  std::optional<Selection> for_more(double reached, const Selection& start, const Effort& effort,
                                    std::uint32_t seed, const RunControl& control) const;

 private:
  /// A selection that reaches the weight `target`, or more if the target is raised with each that does.
  std::optional<Selection> best(double target, bool raises, const Selection& start, const Effort& effort,
                                std::uint32_t seed, const RunControl& control) const;

  const Instance& instance_;
  SearchMatrix matrix_;
  ActiveRows rows_;  ///< all of them
  const LabelWeights& weights_;
};

}  // namespace shelfbeam::detail
