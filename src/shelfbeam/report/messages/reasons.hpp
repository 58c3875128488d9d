#pragma once

#include <functional>
#include <string>
#include <vector>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/plan/answer/availability.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

// The reasons for the units of a plan for a changing shop: the effect of each change alone.

/// "dark surfaces": a cause, by its name in files.
std::string_view change_name(const Words& words, const std::string& cause);

/// A change with the labels that it takes from the plan for the shop as the file gives it, or from the
/// mounted units, and, in a plan, the units that it needs alone.
struct ReasonRow {
  std::string change, taken, units;
};

/// The shop as the file gives it, each change, and all together. Empty if no change was examined alone.
std::vector<ReasonRow> reason_rows(const Words& words, const Availability& availability,
                                   const Placement& placement);

/// How the rows came about.
std::string reasons_note(const Words& words, const Availability& availability);

/// Recommends the plan for the changing shop instead of that for the shop as the file gives it, with the
/// reason; empty if no plan was found, and for mounted units.
std::string states_recommendation(const Words& words, const Availability& availability,
                                  const Placement& placement);

/// The cause that makes every state miss a label, "stock or people"; empty if none is known.
std::string cause_of_loss(const Words& words, const Availability& availability, LabelId label);

/// "Missed in every state: A1 (dark surfaces).", with the first labels; empty if there are none.
std::string lost_sentence(const Words& words, const Availability& availability,
                          const std::function<std::string(LabelId)>& name);

}  // namespace shelfbeam
