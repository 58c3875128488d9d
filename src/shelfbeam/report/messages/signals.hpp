#pragma once

#include <cstddef>
#include <string>

#include "shelfbeam/plan/answer/given_signals.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

/// Why signals do not fit a scene, after "because".
std::string reason_text(const Words& words, const MisfitReason& reason);

/// The use of the signals `name`, with the numbers of labels and candidates of a plan: the whole line about
/// its simulation if they are reused, otherwise the beginning of this line.
std::string signals_text(const Words& words, const GivenSignals& given, std::size_t labels,
                         std::size_t candidates, const std::string& name);

}  // namespace shelfbeam
