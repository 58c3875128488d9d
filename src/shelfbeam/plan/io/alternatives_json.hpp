#pragma once

#include "shelfbeam/placement/io/record.hpp"
#include "shelfbeam/plan/answer/alternatives.hpp"

namespace shelfbeam::detail {

/// The object under `alternatives` (docs/formats/placement.md).
void describe(Record& record, Alternatives& alternatives);

}  // namespace shelfbeam::detail
