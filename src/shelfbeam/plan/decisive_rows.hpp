#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/answer/placement.hpp"

namespace shelfbeam {

/// The same question about some labels: the rows of a table, ascending.
SignalTable table_of_rows(const SignalTable& table, const std::vector<std::uint32_t>& rows);

struct DecisiveRows {
  std::vector<std::uint32_t> rows;  ///< ascending
  bool suffice = false;             ///< these labels alone need `count` units
};

/// A few labels that need so many units by themselves, found by adding what the best placement for those so
/// far leaves unmet. A bound that is to be proven on fresh samples needs these alone to be simulated. Where
/// they do not suffice, some selection of fewer units meets all labels, or time was short: the limits of
/// `options` are of time for all placements together, and of steps for each.
DecisiveRows decisive_rows(const SignalTable& table, const Question& question, std::size_t count,
                           const PlaceOptions& options, const RunControl& control);

}  // namespace shelfbeam
