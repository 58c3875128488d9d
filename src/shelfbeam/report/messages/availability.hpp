#pragma once

#include <functional>
#include <string>
#include <vector>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/plan/answer/availability.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

// Sentences about a plan for a shop that changes.

/// The id of a label by its number.
using LabelName = std::function<std::string(LabelId)>;

/// "98.3 %": rounded down, so that 100 % means always.
std::string time_share(const Words& words, double share);

/// "every label at least 95 % of the time"
std::string goal_text(const Words& words, const Availability& availability);

/// "6 transceivers reach every label at least 95 % of the time, with 99 % confidence.": the answer, or the
/// labels that prevent one, and their causes.
std::string availability_sentence(const Words& words, const Availability& availability,
                                  const Placement& placement, const LabelName& name);

/// "At least 4 transceivers are needed, with 99 % confidence."; empty without a bound beyond the sample.
std::string availability_bound(const Words& words, const Availability& availability,
                               const Placement& placement);

/// The fewest units that satisfy the sampled states, and the plan for the shop as the file gives
/// it.
std::vector<std::string> availability_remarks(const Words& words, const Availability& availability,
                                              const Placement& placement);

/// "A1-front-1-1 (people), A3-back-1-2 (stock)": labels with their main causes, the first few of them.
std::string labels_by_cause(const Words& words, const Availability& availability,
                            const std::vector<LabelId>& labels, const LabelName& name);

}  // namespace shelfbeam
