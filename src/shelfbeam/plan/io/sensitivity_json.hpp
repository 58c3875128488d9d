#pragma once

#include "shelfbeam/placement/io/record.hpp"
#include "shelfbeam/plan/answer/sensitivity.hpp"

namespace shelfbeam::detail {

/// The object under `sensitivity` (docs/formats/placement.md).
void describe(Record& record, Sensitivity& sensitivity);

}  // namespace shelfbeam::detail
