#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "shelfbeam/placement/coverage/label_weights.hpp"

namespace shelfbeam::detail {

/// A unit of a selection and the weight of the labels that only the selection with it reaches.
struct LeastUseful {
  std::uint32_t column = 0;
  double weight = 0;
};

/// The unit, not an installed one, with which the least weight is lost, of equal ones the one with the least
/// lack; nullopt if all are installed. Examines the table once.
std::optional<LeastUseful> least_useful(const SignalTable& table, const PlacementProblem& problem,
                                        const LabelWeights& weights,
                                        const std::vector<std::uint32_t>& selected);

/// Removes units as long as this loses no weight.
std::vector<std::uint32_t> without_useless(const SignalTable& table, const PlacementProblem& problem,
                                           const LabelWeights& weights, std::vector<std::uint32_t> selected);

/// The weight of the labels that a selection reaches, by the checker.
double weight_of(const SignalTable& table, const PlacementProblem& problem, const LabelWeights& weights,
                 const std::vector<std::uint32_t>& selected);

}  // namespace shelfbeam::detail
