#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/report/data/report_data.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

// Sentences about the labels that a selection reaches.

/// "1 transceiver reaches", "2 transceivers reach"
std::string units_reach(const Words& words, std::size_t units);

/// "all 12 labels", "the only label"
std::string all_labels(const Words& words, std::size_t labels);

/// "3 of 12 labels", or all_labels().
std::string labels_reached(const Words& words, std::size_t reached, std::size_t labels);

/// "No selection reaches all 12 labels"
std::string no_selection_reaches(const Words& words, std::size_t labels);

/// ", even if any one unit fails" for redundant problems.
std::string_view failure_clause(const Words& words, const PlacementProblem& problem);

/// "The greedy method", "The search": the method that found no selection. Empty where the time limit was the
/// reason.
std::string_view method_without_result(const Words& words, const Placement& placement);

// Reasons why labels cannot be reached. Where a mounting point has several candidates, they are its options.

/// "12 pairs of candidates are excluded: units must be at least 2 m apart"; empty without conflicts.
std::string conflict_sentence(const Words& words, const Placement& placement);

/// "each mounting point takes only one unit and units must be at least 2 m apart": the reason why each label
/// can be reached, but not all together. Empty without options and conflicts.
std::string conflict_reason(const Words& words, const Placement& placement, bool has_options);

/// Continues "each label ...": "can be reached, but not all of them together, because each mounting point
/// takes only one unit".
std::string not_all_together(const Words& words, std::string_view conflict_reason);

/// "no light arrives; check whether ...": the reason why Unreachable::most is 0. `is_heard`: the label has an
/// entry above 0.
std::string_view no_signal_reason(const Words& words, const PlacementProblem& problem, bool is_heard);
/// A sentence about the labels that no light reaches.
std::string dark_labels(const Words& words, std::size_t labels);

/// "3 cannot be reached even by all candidates together"
std::string terminal_out_of_reach(const Words& words, const Placement& placement, bool has_options);
/// "3 of 12 labels cannot be reached, even with all 320 candidates switched on"
std::string page_out_of_reach(const ReportData& data);

/// The condition under which a label receives LabelOutcome::best: "if every candidate were switched on".
std::string_view maximum_signal_condition(const ReportData& data);

}  // namespace shelfbeam
