#pragma once

#include <cstdint>
#include <optional>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/coverage/label_weights.hpp"
#include "shelfbeam/placement/kernels/search_instance.hpp"
#include "shelfbeam/placement/kernels/walks.hpp"

namespace shelfbeam::detail {

/// A selection with fewer units than `start` that reaches labels of the weight `target`, or with at most as
/// many if `start` does not; nullopt if none is found. The annealing of `anneal`, in which the labels that
/// lack most do not count as far as their weight may be missed. Precondition: can_anneal.
std::optional<Selection> anneal_reach(const SearchInstance& instance, const SearchMatrix& all,
                                      const LabelWeights& weights, double target, const Selection& start,
                                      const Effort& effort, std::uint32_t seed, const RunControl& control);

}  // namespace shelfbeam::detail
