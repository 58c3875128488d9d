#include "shelfbeam/report/terminal/plan_text.hpp"

#include <fmt/format.h>

#include "shelfbeam/report/messages/known_values.hpp"
#include "shelfbeam/report/messages/open_bound.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/terminal/placement_text.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

PlanText plan_text(const CertifiedPlan& plan, const SignalTable& table, bool has_scope) {
  if (const auto& availability = plan.availability) {
    PlanText text{availability_answer(*availability, plan.placement, table),
                  basis_of(english(), plan),
                  {},
                  availability_details(*availability, plan.placement, table)};
    if (availability->is_impossible()) return text;
    text.details += chosen(plan.placement.selected, table);
    if (const std::string price = price_sentence(english(), plan.placement); !price.empty())
      text.details += fmt::format("  {}\n", price);
    return text;
  }
  std::string placed = describe(plan.placement, table), open = open_bound(english(), plan);
  if (plan.certificate)
    return {certificate_sentence(english(), plan, has_scope), basis_of(english(), plan), std::move(open),
            "on the simulated signals: " + placed};
  const std::size_t end = placed.find('\n');
  std::string answer = placed.substr(0, end);
  placed.erase(0, end + 1);
  if (plan.placement.has_selection()) answer += fmt::format(" {}", english()("certificate.lacking"));
  return {std::move(answer), basis_of(english(), plan), std::move(open), std::move(placed)};
}

}  // namespace shelfbeam
