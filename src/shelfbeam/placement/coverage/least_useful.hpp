#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/coverage/label_weights.hpp"
#include "shelfbeam/placement/problem/effort.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam::detail {

/// A unit of a selection and the weight of the labels that only the selection with it reaches.
struct LeastUseful {
  ColumnId column;
  double weight = 0;
};

/// The unit, not an installed one, with which the least weight is lost, of equal ones the one with the least
/// lack; nullopt if all are installed. Examines the table once.
std::optional<LeastUseful> least_useful(const Instance& instance, const LabelWeights& weights,
                                        const Selection& selected);

/// Removes units as long as this loses no weight and the effort is not over.
Selection without_useless(const Instance& instance, const LabelWeights& weights, Selection selected,
                          const Effort& effort, const RunControl& control);

/// The first units of an order, ascending.
Selection first_units(std::span<const ColumnId> order, std::size_t units);

/// The weight of the labels that a selection reaches, by the checker.
double weight_of(const Instance& instance, const LabelWeights& weights, const Selection& selected);

}  // namespace shelfbeam::detail
