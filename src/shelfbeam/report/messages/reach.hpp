#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/report/data/report_data.hpp"

namespace shelfbeam {

// What a selection reaches.

/// "1 transceiver reaches", "2 transceivers reach"
std::string units_reach(std::size_t units);

/// "all 12 labels", "the only label"
std::string all_labels(std::size_t labels);

/// "3 of 12 labels"; all of them as above.
std::string labels_reached(std::size_t reached, std::size_t labels);

/// "No selection reaches all 12 labels"
std::string no_selection_reaches(std::size_t labels);

/// ", whichever unit fails", where the question asks for that.
std::string_view whichever_fails(const Question& question);

/// "The greedy method", "The search": who found no selection before the time was over; empty where that was
/// the reason.
std::string_view who_gave_up(const Placement& placement);

/// Said of a curve or of the search for it.
inline constexpr std::string_view cut_short = "was stopped early: more time may bring the two nearer";

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
