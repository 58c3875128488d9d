#pragma once

#include "shelfbeam/placement/io/record.hpp"
#include "shelfbeam/plan/answer/availability.hpp"

namespace shelfbeam::detail {

/// The object under `states` (docs/formats/placement.md).
void describe(Record& record, Availability& availability);

}  // namespace shelfbeam::detail
