#pragma once

#include <cstdint>
#include <optional>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/coverage/label_weights.hpp"
#include "shelfbeam/placement/kernels/search_instance.hpp"
#include "shelfbeam/placement/kernels/walks.hpp"

namespace shelfbeam::detail {

/// Whether annealing can hold all labels x candidates of the table.
bool can_anneal_coverage(const SignalTable& table);

/// A selection with fewer units than `start` that reaches labels of the weight `target`, or with at most as
/// many if `start` does not; nullopt if none is found. The annealing of `anneal`, but of the missed weight
/// beyond the weight that may be missed, on all labels. Precondition: can_anneal_coverage.
std::optional<Selection> anneal_reach(const SearchInstance& instance, const SearchMatrix& all,
                                      const LabelWeights& weights, double target, const Selection& start,
                                      const Effort& effort, std::uint32_t seed, const RunControl& control);

/// A selection of as many units as `start` that reaches labels of more weight than `reached`; nullopt if none
/// is found. The same annealing at a fixed count: whenever a selection reaches more, it must reach still more
/// from then on. Precondition: can_anneal_coverage.
std::optional<Selection> anneal_coverage(const SearchInstance& instance, const SearchMatrix& all,
                                         const LabelWeights& weights, double reached, const Selection& start,
                                         const Effort& effort, std::uint32_t seed, const RunControl& control);

}  // namespace shelfbeam::detail
