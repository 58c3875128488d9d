#include "shelfbeam/report/messages/known_values.hpp"

#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

std::string verified_words(const Words& words, const CertifiedPlan& plan) {
  return words.say(fmt::format("verdict.certified.yes.{}", to_text(plan.weakest_state())));
}

std::string value_words(const Words& words, const DecisiveValue& value) {
  const std::string name = words.say(fmt::format("values.kind.{}", to_text(value.kind)), value.of);
  if (!(value.amount > 0)) return name;
  return words.say(
      "values.value", name,
      words.say(fmt::format("values.amount.{}", to_text(value.kind)), words.plain(value.amount, 4)));
}

std::string assumed_sentence(const Words& words, const CertifiedPlan& plan) {
  std::vector<std::string> assumed;
  for (const DecisiveValue& value : plan.values)
    if (value.state == ValueState::assumed) assumed.push_back(value_words(words, value));
  if (assumed.empty()) return {};
  return words.say(plan.is_example ? "values.invented" : "values.assumed",
                   fmt::format("{}", fmt::join(assumed, ", ")));
}

std::string basis_of(const Words& words, const CertifiedPlan& plan, bool is_certified) {
  std::string basis = is_certified ? verified_words(words, plan) + "." : "";
  if (const std::string assumed = assumed_sentence(words, plan); !assumed.empty())
    basis += (basis.empty() ? "" : " ") + assumed;
  return basis;
}

std::string basis_of(const Words& words, const CertifiedPlan& plan) {
  const bool is_certified =
      plan.availability
          ? plan.availability->certified && !plan.availability->is_impossible()
          : plan.certificate && plan.placement.has_selection() && plan.certificate->all_reached();
  return basis_of(words, plan, is_certified);
}

}  // namespace shelfbeam
