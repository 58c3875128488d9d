#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "shelfbeam/placement/answer/placement.hpp"

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

}  // namespace shelfbeam
