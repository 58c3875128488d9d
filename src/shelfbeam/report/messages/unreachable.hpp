#pragma once

#include <string>
#include <string_view>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/report/data/report_data.hpp"

namespace shelfbeam {

// Why labels cannot be reached. Candidates are options where some mounting points have several of them.

/// "12 pairs of candidates are kept apart: units must be 2 m apart"; empty where nothing was asked for.
std::string kept_apart(const Placement& placement);

/// "a mounting point holds one unit and units must be 2 m apart": why each label could be reached, but not
/// all of them at once. Empty where nothing is known to exclude anything.
std::string why_exclusive(const Placement& placement, bool has_options);

/// "could be reached, but not all of them at once, because a mounting point holds one unit", said of each
/// label.
std::string not_all_at_once(std::string_view why_exclusive);

/// "no light arrives at all: is it inside something, or facing into it?": why Unreachable::most is 0.
/// `is_heard`: the label has some entry above 0.
std::string_view why_nothing(const Question& question, bool is_heard);
/// The same of labels that no light reaches, several or one, as a sentence.
std::string dark_labels(std::size_t labels);

/// "3 cannot be reached even by all candidates together"
std::string terminal_out_of_reach(const Placement& placement, bool has_options);
/// "3 of 12 labels cannot be reached, even with all 320 candidates on"
std::string page_out_of_reach(const ReportData& data);

/// The condition under which a label gets LabelOutcome::best: "if every candidate were on".
std::string_view everything_on(const ReportData& data);

}  // namespace shelfbeam
