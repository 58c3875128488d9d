#include "shelfbeam/report/messages/partial.hpp"

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/messages/reach.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

std::string of_units(const Words& words, const PartialReach& partial, std::size_t labels) {
  const auto units = static_cast<std::size_t>(partial.value);
  if (partial.reached == labels) return words.say_count("partial.at_most.all", units);
  return words.say_count(
      partial.reached >= partial.max_reached ? "partial.at_most.proven" : "partial.at_most.open", units,
      words.grouped(partial.max_reached));
}

std::string of_share(const Words& words, const Placement& placement, const PartialReach& partial,
                     std::size_t labels) {
  const std::string share = words.percent(partial.value);
  if (placement.status == Status::infeasible)
    return words.say("partial.share.none", share, labels_reached(words, partial.max_reached, labels));
  if (!placement.has_selection())
    return words.say("partial.share.some", share, units_needed(words, proven_count(placement)));
  return words.say("partial.share.some", share, terminal_bound(words, placement));
}

}  // namespace

std::string partial_sentence(const Words& words, const Placement& placement, std::size_t labels) {
  if (!placement.partial) return {};
  switch (placement.partial->goal) {
    case ReachGoal::at_most:
      return of_units(words, *placement.partial, labels);
    case ReachGoal::share:
      return of_share(words, placement, *placement.partial, labels);
    case ReachGoal::given:
      break;
  }
  return words.say("partial.given");
}

}  // namespace shelfbeam
