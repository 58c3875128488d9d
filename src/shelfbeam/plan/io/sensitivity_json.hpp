#pragma once

#include "shelfbeam/placement/io/placement_json.hpp"
#include "shelfbeam/plan/answer/sensitivity.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam::detail {

/// The object under `sensitivity` (docs/formats/placement.md).
Json sensitivity_object(const Sensitivity& sensitivity, const SignalTable& table);
Sensitivity read_sensitivity(const JsonCursor& cursor, const SignalTable& table);

}  // namespace shelfbeam::detail
