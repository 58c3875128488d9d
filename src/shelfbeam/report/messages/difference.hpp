#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "shelfbeam/plan/difference/plan_difference.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

// Sentences and tables about the differences between two plans, for terminal and page.

/// Two plans and their difference.
struct DifferenceInput {
  const ComparedPlan &before, &after;
  const PlanDifference& difference;
};

/// "One unit fewer: 9 instead of 10; all 686 labels stay reached."
std::string difference_answer(const Words& words, const DifferenceInput& input);

/// Cells of a table; the first row contains the headings.
using TextTable = std::vector<std::vector<std::string>>;

/// Units, price, labels, certificate, bound: the name of a figure, its value before, its value after. Then
/// the settings of the question that differ.
TextTable difference_figures(const Words& words, const DifferenceInput& input);

/// Units that are not kept: number, change, id, and position before and after, with axis and type where these
/// differ. Only the headings if there are none.
TextTable changed_units(const Words& words, const DifferenceInput& input);

/// "6 units kept, 1 added"
std::string unit_counts(const Words& words, const PlanDifference& difference);

/// The id of a label in the second plan, or in the first if only that has it.
const std::string& label_id(const DifferenceInput& input, const ComparedLabel& label);
/// Its name there.
const std::string& label_name(const DifferenceInput& input, const ComparedLabel& label);

/// At most `most` labels with a change, smallest margin in the second plan first: name, margins before and
/// after.
TextTable changed_labels(const Words& words, const DifferenceInput& input, LabelChange change,
                         std::size_t most);

/// The weakest labels of both plans, in the order of their margins in the second plan.
TextTable weakest_labels(const Words& words, const DifferenceInput& input);

/// The changes whose labels are listed, the most urgent first.
inline constexpr std::array listed_changes{LabelChange::lost, LabelChange::gained, LabelChange::stays_missed,
                                           LabelChange::added};

/// "3 labels gained"; "30 labels gained, the first 5" where at most so many are listed.
std::string labels_heading(const Words& words, LabelChange change, std::size_t count, std::size_t most);

/// One line per kind of change in each part of the store. Of many elements, only the first ids are named.
std::vector<std::string> store_lines(const Words& words, const PlanDifference& difference);

}  // namespace shelfbeam
