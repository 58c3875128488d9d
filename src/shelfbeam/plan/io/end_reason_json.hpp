#pragma once

#include <optional>

#include "shelfbeam/placement/io/placement_json.hpp"
#include "shelfbeam/plan/answer/end_reason.hpp"

namespace shelfbeam::detail {

/// The object with the code and its values; null without a reason.
Json to_json(const std::optional<EndReason>& reason);

/// Also reads the text of format 1. Throws InputError.
std::optional<EndReason> read_end_reason(const JsonCursor& json);

}  // namespace shelfbeam::detail
