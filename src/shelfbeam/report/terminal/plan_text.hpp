#pragma once

#include <string>

#include "shelfbeam/plan/answer/certified_plan.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam {

/// A plan in a few lines for a terminal.
struct PlanText {
  std::string answer;   ///< one line
  std::string basis;    ///< basis_of(); may be empty
  std::string open;     ///< open_bound()
  std::string details;  ///< lines about the placement
};

/// `has_scope`: the answer says what its confidence covers.
PlanText plan_text(const CertifiedPlan& plan, const SignalTable& table, bool has_scope = true);

}  // namespace shelfbeam
