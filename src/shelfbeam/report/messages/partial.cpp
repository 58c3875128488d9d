#include "shelfbeam/report/messages/partial.hpp"

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/messages/reach.hpp"
#include "shelfbeam/report/text/catalogue.hpp"

namespace shelfbeam {

namespace {

std::string of_units(const PartialReach& partial, std::size_t labels) {
  const auto units = static_cast<std::size_t>(partial.value);
  if (partial.reached == labels) return say_count("partial.at_most.all", units);
  return say_count(partial.reached >= partial.max_reached ? "partial.at_most.proven" : "partial.at_most.open",
                   units, grouped(partial.max_reached));
}

std::string of_share(const Placement& placement, const PartialReach& partial, std::size_t labels) {
  const std::string share = percent(partial.value);
  if (placement.status == Status::infeasible)
    return say("partial.share.none", share, labels_reached(partial.max_reached, labels));
  if (!placement.has_selection())
    return say("partial.share.some", share, units_needed(proven_count(placement)));
  return say("partial.share.some", share, terminal_bound(placement));
}

}  // namespace

std::string partial_sentence(const Placement& placement, std::size_t labels) {
  if (!placement.partial) return {};
  switch (placement.partial->goal) {
    case ReachGoal::at_most:
      return of_units(*placement.partial, labels);
    case ReachGoal::share:
      return of_share(placement, *placement.partial, labels);
    case ReachGoal::given:
      break;
  }
  return say("partial.given");
}

}  // namespace shelfbeam
