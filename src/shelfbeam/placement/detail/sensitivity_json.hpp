#pragma once

#include "shelfbeam/placement/detail/placement_json.hpp"
#include "shelfbeam/placement/sensitivity.hpp"
#include "shelfbeam/signal/signal_table.hpp"

namespace shelfbeam::detail {

/// The object under `sensitivity` (docs/formats/placement.md).
Json to_json(const Sensitivity& sensitivity, const SignalTable& table);
Sensitivity read_sensitivity(const JsonCursor& cursor, const SignalTable& table);

}  // namespace shelfbeam::detail
