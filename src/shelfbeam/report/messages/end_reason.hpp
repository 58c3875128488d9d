#pragma once

#include <optional>
#include <string>

#include "shelfbeam/plan/answer/end_reason.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

/// The reason, as it follows "because".
std::string end_text(const Words& words, const EndReason& reason);

/// The answer and, if it is known, the time that would decide the rest. Only for the terminal: files have no
/// times.
std::string with_effort(const Words& words, std::string answer, const std::optional<EndReason>& open);

}  // namespace shelfbeam
