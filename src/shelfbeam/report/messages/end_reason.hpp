#pragma once

#include <optional>
#include <string>

#include "shelfbeam/plan/answer/end_reason.hpp"

namespace shelfbeam {

/// The reason, as it follows "because".
std::string end_text(const EndReason& reason);

/// The time that would decide the rest, as a sentence for the terminal; empty if it is unknown.
std::string end_effort(const std::optional<EndReason>& reason);

}  // namespace shelfbeam
