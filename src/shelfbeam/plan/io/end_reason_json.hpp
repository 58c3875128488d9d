#pragma once

#include <optional>

#include "shelfbeam/placement/io/record.hpp"
#include "shelfbeam/plan/answer/end_reason.hpp"

namespace shelfbeam::detail {

/// The key "open": the code and its values, null without a reason; in format 1 a text.
void describe_end(Record& record, std::optional<EndReason>& reason);

}  // namespace shelfbeam::detail
