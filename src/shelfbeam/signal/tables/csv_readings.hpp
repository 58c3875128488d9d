#pragma once

#include <string>
#include <vector>

#include "shelfbeam/signal/tables/signal_table.hpp"

// Whether a CSV matrix fits a second reading, too (docs/formats/matrices.md).

namespace shelfbeam::detail {

/// Whether the first row of a matrix without ids may be a header: its numbers are whole, and they count up,
/// are different above signals that are not all whole, or are all much larger. The first number may be above
/// the ids of labels.
bool may_be_header(const std::vector<std::string>& row, const SignalTable& table);

/// Whether the first column of a matrix without ids may have the ids of labels: whole numbers that count up
/// beside signals that are not all whole, or are all much larger.
bool may_be_labels(const std::vector<std::string>& column, const SignalTable& table);

/// Whether the first column of a matrix with ids may have signals: only numbers, below the title of another
/// transceiver. These are not all whole, or are all 0 or 1, or the titles count up ("T1", "T2").
bool may_be_signals(const std::string& title, const SignalTable& table);

}  // namespace shelfbeam::detail
